#pragma once

#include "sim/render/image.h"

namespace assay::opencv {

// Implements render::WithCaption.
render::Image WithCaption(const render::Image& image, const render::Caption& caption);

}  // namespace assay::opencv
