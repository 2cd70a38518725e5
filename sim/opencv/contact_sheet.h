#pragma once

#include "sim/render/image.h"
#include "sim/render/picture.h"

namespace assay::opencv {

// Implements render::ContactSheet. The arguments must have been checked.
render::Image ContactSheet(const std::vector<render::CaptionedImage>& images, int columns,
                           const std::vector<render::LegendEntry>& legend);

}  // namespace assay::opencv
