# Which tests `./run test --arm64` leaves out, by label, and why (docs/arm64.md). QEMU
# translates every instruction: what takes a second otherwise takes half a minute.

# QEMU keeps no limit on address space (setrlimit), which the first sets, and no filter of
# system calls (seccomp), which the next sets; the others want to see what a render has
# done in 0.2 s, and a pilot in 2.5 s.
set(unable cli/lost_renders_test sweep/directory_test
  run/put_down_test cli/advise_test)
# Scripts that start the program themselves, or preload a library into it.
list(APPEND unable cases_run_once cli/completion docs/links failures/kill failures/disk
  failures/foreign)
# Nothing of them runs on ARM.
set(unrelated bench/simulate_cluster bench/efficiency build/version)
# More than 12 s of processor time.
set(long
  accel/spatial_split_test advise/advise_test
  cli/profile_test cli/render_test cli/stress_test
  cli/study_command_test cli/target_test compile/materials_test
  compile/medium_emission_test compile/nested_test compile/tessellate_test
  control/regression_render_test control/regression_test
  directions/uniform_test estimate/estimate_test generate/lenses_test
  image/accumulator_test image/long_sums_test
  lights/emission_images_test lights/image_lights_test lights/portal_test
  lights/projected_test media/agreement_test media/coloured_test media/distances_test
  media/varying_test parse/format_test points/convergence_test
  reference/closed_form_test reference/estimators_test
  render/cuts_test render/many_samples_test report/page_test roulette/closed_room_test
  roulette/efficiency_test roulette/shadow_test roulette/splitting_test
  roulette/unsplit_test scenes/closed_form_scenes_test scenes/scenes_test
  shade/coat_medium_test shade/limits_test shade/reference_test stat/convergence_test
  stat/efficiency_test stat/interval_test state/integrity_test strategy/unbiased_test
  stress/geometry_cases_test stress/suite_test stress/transport_cases_test
  study/calibration_test study/render_reference_test study/shared_bias_test
  study/study_test sweep/again_test sweep/parts_test sweep/ten_thousand_test
  texture/pattern_kernel_test agreement/agreement_test
  agreement/alpha_places_test agreement/closed_form_test
  run/convergence_test train/decision_test plan/declared_fields_test
  wave/determinism_test agreement/force_diffuse_test agreement/mirrored_lights_test
  run/open_ended_test agreement/relief_agreement_test
  run/resume_mistakes_test run/resume_test agreement/round_shapes_test
  wave/seen_lights_test agreement/textured_test
  # Where scenes from elsewhere are found: more than 600 s, and 511 s.
  scenes/reference_images_test train/decision_scenes_test)

foreach(kind unable unrelated long)
  foreach(test ${${kind}})
    set_property(TEST ${test} APPEND PROPERTY LABELS qemu-${kind})
  endforeach()
endforeach()
