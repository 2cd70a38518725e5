#pragma once

#include "sim/render/image.h"

namespace assay::render {

// The picture of a drawing that is `samples` times too wide and too high, and whose rows, as
// OpenGL's, begin at the bottom. OSMesa has no other antialiasing that is the same on every
// machine.
Image FromSamples(const Image& drawing, int samples);

}  // namespace assay::render
