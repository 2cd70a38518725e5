#pragma once

#include <span>

#include "sim/render/image.h"
#include "sim/render/picture.h"

namespace assay::opencv {

// Implements render::WithLabels.
render::Image WithLabels(const render::Image& image, std::span<const render::Label> labels);

}  // namespace assay::opencv
