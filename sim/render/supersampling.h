#pragma once

#include "sim/render/image.h"

namespace assay::render {

// Pictures are drawn this many times too wide and too high, and averaged: OSMesa has no other
// antialiasing that is the same on every machine.
inline constexpr int kSupersampling = 2;

// The picture of a drawing whose rows, as OpenGL's, begin at the bottom.
Image FromSamples(const Image& drawing);

}  // namespace assay::render
