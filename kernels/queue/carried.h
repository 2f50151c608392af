// What a path takes along from one wave to the next.
#pragma once

#include "src/path/fields.h"

namespace lanelight {

/// True but for the columns that every bounce writes before it reads them.
constexpr bool IsCarried(Field f) {
  switch (f) {
    case Field::b1:
    case Field::b2:
    case Field::inst:
    case Field::p_x:
    case Field::p_y:
    case Field::p_z:
    case Field::p_error:
    case Field::ng_x:
    case Field::ng_y:
    case Field::ng_z:
    case Field::ns_x:
    case Field::ns_y:
    case Field::ns_z:
    case Field::tg_x:
    case Field::tg_y:
    case Field::tg_z:
    case Field::uv_u:
    case Field::uv_v:
    case Field::material:
    case Field::color0_r:
    case Field::color0_g:
    case Field::color0_b:
    case Field::color1_r:
    case Field::color1_g:
    case Field::color1_b:
    case Field::alpha_x:
    case Field::alpha_y:
    case Field::u_lens_0:
    case Field::u_lens_1:
    case Field::u_lobe:
    case Field::u_bsdf_0:
    case Field::u_bsdf_1:
    case Field::u_select:
    case Field::u_light_0:
    case Field::u_light_1:
    case Field::u_roulette:
    case Field::ls_light:
    case Field::ls_x:
    case Field::ls_y:
    case Field::ls_z:
    case Field::ls_distance:
    case Field::ls_r:
    case Field::ls_g:
    case Field::ls_b:
    case Field::ls_pdf:
    case Field::light_pmf:
    case Field::sh_r:
    case Field::sh_g:
    case Field::sh_b:
      return false;
    default:
      return true;
  }
}

/// Those of a path, for the declaration of a stage.
inline FieldSet CarriedFields() {
  FieldSet carried;
  for (std::size_t i = 0; i < kNumFields; ++i) {
    const Field f = static_cast<Field>(i);
    if (IsCarried(f)) carried = carried | FieldSet{f};
  }
  return carried;
}

/// The live ones of a wavefront.
struct CarriedColumns {
  std::uint32_t* columns[kNumFields];
  std::uint32_t count = 0;

  explicit CarriedColumns(const PathColumns& p) {
    // The film position is read again only by what fits a control variate to it, and the
    // last hit only by what intersects triangles.
    const bool film = p.first_0 != nullptr, triangles = p.b1 != nullptr;
#define X(type, name, features, meaning)                                              \
  if (p.name != nullptr && IsCarried(Field::name) &&                                  \
      (film || (Field::name != Field::u_film_0 && Field::name != Field::u_film_1)) && \
      (triangles || Field::name != Field::prim)) {                                    \
    columns[count++] = reinterpret_cast<std::uint32_t*>(p.name);                      \
  }
    LANELIGHT_PATH_FIELDS(X)
#undef X
  }
};

}  // namespace lanelight
