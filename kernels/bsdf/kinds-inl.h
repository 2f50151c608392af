// The policies of all kinds of materials (LANELIGHT_SHADE_KINDS), by the name of the
// kind.
#ifndef LANELIGHT_BSDF_KINDS_INL_H_
#define LANELIGHT_BSDF_KINDS_INL_H_

#include "kernels/bsdf/coated_conductor-inl.h"
#include "kernels/bsdf/coated_diffuse-inl.h"
#include "kernels/bsdf/coated_medium-inl.h"
#include "kernels/bsdf/conductor-inl.h"
#include "kernels/bsdf/dielectric-inl.h"
#include "kernels/bsdf/diffuse-inl.h"
#include "kernels/bsdf/hair-inl.h"
#include "kernels/bsdf/henyey_greenstein-inl.h"
#include "kernels/bsdf/measured-inl.h"

#endif
