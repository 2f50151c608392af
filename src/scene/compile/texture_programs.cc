#include "src/scene/compile/texture_programs.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/scene/compile/coat.h"
#include "src/scene/compile/textures.h"

namespace lanelight {
namespace {

// Appends the program of one texture to the table.
class ProgramBuilder {
 public:
  ProgramBuilder(const std::vector<Texture>& textures, const TextureImageLoader& images,
                 const Transform& world_from_scene, TextureTable& table)
      : textures_(textures),
        images_(images),
        world_from_scene_(world_from_scene),
        table_(table) {}

  void Build(Index texture) {
    register_of_.clear();
    const std::set<Index> used = Reachable(texture);
    const std::size_t begin = table_.nodes.size();
    for (Index t : used) AddNode(t);
    const bool uses_place =
        std::ranges::any_of(used, [&](Index t) { return UsesPlace(textures_[t]); });
    table_.programs.push_back({static_cast<std::int32_t>(begin),
                               static_cast<std::int32_t>(table_.nodes.size() - begin),
                               uses_place});
  }

 private:
  // Every texture that `root` needs and that is not constant, and `root`. A texture
  // refers to earlier ones only, so increasing order is an order of evaluation.
  std::set<Index> Reachable(Index root) const {
    std::set<Index> used = {root};
    std::vector<Index> open = {root};
    while (!open.empty()) {
      const Texture& t = textures_[open.back()];
      const Index at = open.back();
      open.pop_back();
      for (Index child : {t.tex1.texture, t.tex2.texture, t.amount.texture}) {
        if (!HasOperands(t) || child == kNone) continue;
        LL_CHECK(child >= 0 && child < at);
        if (textures_[child].kind == TextureKind::kConstant) continue;
        if (used.insert(child).second) open.push_back(child);
      }
      if (used.size() > static_cast<std::size_t>(kMaxTextureNodes)) {
        throw InputError(textures_[root].where,
                         fmt::format("texture \"{}\" combines more than {} others",
                                     textures_[root].name, kMaxTextureNodes - 1));
      }
    }
    return used;
  }

  static bool HasOperands(const Texture& t) {
    constexpr TextureKind kCombining[] = {
        TextureKind::kScale,        TextureKind::kMix,
        TextureKind::kCheckerboard, TextureKind::kDirectionMix,
        TextureKind::kDots,         TextureKind::kMetalExtinction,
        TextureKind::kCoatedBase,   TextureKind::kRegularAlpha};
    return std::ranges::find(kCombining, t.kind) != std::end(kCombining);
  }

  void AddNode(Index index) {
    const Texture& t = textures_[index];
    TextureNode node;
    node.kind = t.kind;
    if (t.kind == TextureKind::kConstant) SetConstant(node, 0, t.value);
    if (HasOperands(t)) {
      SetOperand(node, 0, t.tex1.texture, t.tex1.constant);
      SetOperand(node, 1, t.tex2.texture, t.tex2.constant);
      const double amount = t.amount.constant;
      SetOperand(node, 2, t.amount.texture, {amount, amount, amount});
    }
    for (int i = 0; t.kind == TextureKind::kBilinear && i < 4; ++i) {
      SetConstant(node, i, t.corners[i].constant);
    }
    node.su = static_cast<float>(t.mapping.su),
    node.sv = static_cast<float>(t.mapping.sv);
    node.du = static_cast<float>(t.mapping.du),
    node.dv = static_cast<float>(t.mapping.dv);
    SetPlace(t, world_from_scene_, node);
    if (t.kind == TextureKind::kCoatedBase) {
      node.fit = CoatFitOffset(t.amount.constant, t.octaves);
    }
    if (t.kind == TextureKind::kCheckerboard && t.dimension == 2) node.filter = t.filter;
    if (t.kind == TextureKind::kImage) {
      node.image = images_.ImageIndex(t);
      node.wrap = t.wrap;
      node.bilinear = t.bilinear;
      node.filter = t.filter;
      node.max_anisotropy = static_cast<float>(t.max_anisotropy);
      node.invert = t.invert;
      node.scale = static_cast<float>(t.scale);
    }
    register_of_[index] = static_cast<std::int32_t>(register_of_.size());
    table_.nodes.push_back(node);
  }

  // Coats that are nearly alike share a table: the correction is small, so that two
  // digits of what it depends on are plenty.
  std::int32_t CoatFitOffset(double internal, int bounces) {
    const int hundredths = static_cast<int>(std::lround(internal * 100));
    const auto at = static_cast<std::int32_t>(table_.fits.size());
    const auto [it, is_new] = fits_.try_emplace({hundredths, bounces}, at);
    if (is_new) {
      const std::vector<float> fit = coat_fits_.Table(hundredths / 100.0, bounces);
      table_.fits.insert(table_.fits.end(), fit.begin(), fit.end());
    }
    return it->second;
  }

  void SetOperand(TextureNode& node, int slot, Index texture, const Rgb& constant) {
    if (texture == kNone) return SetConstant(node, slot, constant);
    const Texture& child = textures_[texture];
    if (child.kind == TextureKind::kConstant) return SetConstant(node, slot, child.value);
    node.operand[slot] = register_of_.at(texture);
  }
  static void SetConstant(TextureNode& node, int slot, const Rgb& value) {
    for (int c = 0; c < 3; ++c) node.constant[slot][c] = static_cast<float>(value[c]);
  }

  const std::vector<Texture>& textures_;
  const TextureImageLoader& images_;
  const Transform& world_from_scene_;
  TextureTable& table_;
  std::map<Index, std::int32_t> register_of_;
  std::map<std::pair<int, int>, std::int32_t> fits_;
  CoatFits coat_fits_;
};

}  // namespace

TextureTable CompileTextures(const std::vector<Texture>& textures,
                             const Transform& world_from_scene,
                             std::vector<Note>* notes) {
  TextureTable table;
  TextureImageLoader images(textures);
  images.Load(table, notes);
  ProgramBuilder builder(textures, images, world_from_scene, table);
  for (std::size_t i = 0; i < textures.size(); ++i) builder.Build(static_cast<Index>(i));
  return table;
}

}  // namespace lanelight
