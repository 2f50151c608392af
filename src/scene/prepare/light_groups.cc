// Groups of lights (LearnedLights): the parts of a light tree, split at its most powerful
// nodes.
#include <algorithm>
#include <numeric>

#include "src/base/core/alias_table.h"
#include "src/scene/prepare/learned_lights.h"
#include "src/scene/prepare/light_bounds.h"

namespace lanelight {
namespace {

using Groups = std::vector<std::vector<std::uint32_t>>;  // their lights

// Groups of lights without a place: each one by itself, the last ones together.
constexpr std::size_t kMaxFarGroups = kMaxLightGroups / 2;

std::vector<std::uint32_t> LightsBelow(const LightTree& tree, std::int32_t node) {
  std::vector<std::uint32_t> lights;
  std::vector<std::int32_t> open = {node};
  while (!open.empty()) {
    const std::int32_t child = tree.nodes[std::size_t(open.back())].child;
    open.pop_back();
    if (child < 0) {
      lights.push_back(std::uint32_t(~child));
    } else {
      open.insert(open.end(), {child + 1, child});
    }
  }
  return lights;
}

void AddNearGroups(const LightTree& tree, Groups& groups) {
  if (tree.nodes.empty()) return;
  std::vector<std::int32_t> parts = {0};
  const auto weaker = [&tree](std::int32_t a, std::int32_t b) {
    const LightNode &x = tree.nodes[std::size_t(a)], &y = tree.nodes[std::size_t(b)];
    if ((x.child < 0) != (y.child < 0)) return x.child < 0;  // leaves stay
    return x.power < y.power;
  };
  while (groups.size() + parts.size() < kMaxLightGroups) {
    const auto part = std::ranges::max_element(parts, weaker);
    const std::int32_t child = tree.nodes[std::size_t(*part)].child;
    if (child < 0) break;
    *part = child;
    parts.push_back(child + 1);
  }
  for (const std::int32_t part : parts) groups.push_back(LightsBelow(tree, part));
}

Groups MakeGroups(const CompiledScene& scene, std::span<const double> power) {
  const auto& lights = scene.lights.lights;
  Groups groups;
  if (lights.size() <= kMaxLightGroups) {
    for (std::uint32_t i = 0; i < lights.size(); ++i) groups.push_back({i});
    return groups;
  }
  const LightTree tree = BuildLightTree(scene.geometry, lights, power);
  for (const std::uint32_t light : tree.far) {
    if (groups.size() < kMaxFarGroups) groups.emplace_back();
    groups.back().push_back(light);
  }
  AddNearGroups(tree, groups);
  return groups;
}

void AddGroup(const std::vector<std::uint32_t>& lights, std::span<const double> power,
              LearnedLights& table) {
  std::vector<double> weights;
  for (const std::uint32_t light : lights) weights.push_back(power[light]);
  table.first.push_back(std::int32_t(table.member.size()));
  table.count.push_back(std::int32_t(lights.size()));
  const bool dark = std::ranges::all_of(weights, [](double w) { return w == 0; });
  const AliasTable alias =
      BuildAliasTable(dark ? std::vector<double>(lights.size(), 1.0) : weights);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    table.group[lights[i]] = std::int32_t(table.num_groups);
    table.within[lights[i]] = alias.probability[i];
    table.member.push_back(std::int32_t(lights[i]));
    table.member_q.push_back(alias.q[i]);
    table.member_alias.push_back(std::int32_t(lights[alias.alias[i]]));
  }
  ++table.num_groups;
}

}  // namespace

LearnedLights GroupLights(const CompiledScene& scene, std::span<const float> power) {
  LearnedLights table;
  const std::vector<double> weights(power.begin(), power.end());
  table.is_grouped = power.size() > kMaxLightGroups;
  table.group.assign(power.size(), 0);
  table.within.assign(power.size(), 0.0f);
  for (const std::vector<std::uint32_t>& lights : MakeGroups(scene, weights)) {
    AddGroup(lights, weights, table);
  }
  return table;
}

}  // namespace lanelight
