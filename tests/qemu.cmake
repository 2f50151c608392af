# Which tests `./run test --arm64` leaves out, by label, and why (docs/arm64.md). QEMU
# translates every instruction: what takes a second otherwise takes half a minute.

# QEMU keeps no limit on address space (setrlimit), which the first sets, and no filter of
# system calls (seccomp), which the next sets; the others want to see what a render has
# done in 0.2 s, and a pilot in 2.5 s.
set(unable cli/lost_renders_test measure/sweep/directory_test
  render/run/cancel_test)
# Scripts that start the program themselves, or preload a library into it.
list(APPEND unable cases_run_once cli/completion docs/links failures/kill failures/disk
  failures/foreign)
# Nothing of them runs on ARM.
set(unrelated bench/simulate_cluster bench/efficiency build/version)
# More than 12 s of processor time.
set(long
  scene/accel/spatial_split_test
  cli/profile_test cli/render_test cli/stress_test
  cli/study_command_test cli/target_test scene/compile/materials_test
  scene/compile/medium_emission_test scene/compile/nested_test scene/compile/tessellate_test
  kernels/control/regression_render_test kernels/control/regression_test
  kernels/directions/uniform_test render/estimate/estimate_test kernels/generate/lenses_test
  base/image/accumulator_test base/image/long_sums_test
  kernels/lights/emission_images_test kernels/lights/image_lights_test kernels/lights/portal_test
  kernels/lights/projected_test kernels/media/agreement_test kernels/media/coloured_test kernels/media/distances_test
  kernels/media/varying_test scene/parse/format_test kernels/samplers/convergence_test
  reference/closed_form_test reference/estimators_test
  render/job/any_split_test render/job/many_samples_test measure/report/page_test kernels/roulette/closed_room_test
  kernels/roulette/path_values_test kernels/roulette/shadow_test kernels/roulette/splitting_test
  kernels/roulette/single_path_test scenes/closed_form_scenes_test scenes/scenes_test
  kernels/shade/coat_medium_test kernels/shade/limits_test kernels/shade/reference_test base/stat/convergence_test
  base/stat/efficiency_test base/stat/interval_test base/state/integrity_test vocabulary/strategy/unbiased_test
  extremes/materials_test extremes/media_test extremes/paths_test extremes/round_test extremes/scenes_test extremes/triangles_test
  extremes/views_test measure/stress/suite_test
  measure/study/calibration_test measure/study/render_reference_test measure/study/shared_bias_test
  measure/study/study_test measure/sweep/rerun_test measure/sweep/parts_test measure/sweep/ten_thousand_test
  kernels/texture/pattern_kernel_test agreement/agreement_test
  agreement/alpha_places_test agreement/closed_form_test
  render/run/convergence_test render/train/decision_test render/plan/declared_fields_test
  render/wave/determinism_test agreement/force_diffuse_test agreement/mirrored_lights_test
  render/run/open_ended_test agreement/bump_agreement_test
  render/run/resume_mistakes_test render/run/resume_test agreement/round_shapes_test
  render/wave/visible_lights_test agreement/textured_test
  # Where scenes from elsewhere are found: more than 600 s, and 511 s.
  scenes/reference_images_test render/train/decision_scenes_test)

foreach(kind unable unrelated long)
  foreach(test ${${kind}})
    set_property(TEST ${test} APPEND PROPERTY LABELS qemu-${kind})
  endforeach()
endforeach()
