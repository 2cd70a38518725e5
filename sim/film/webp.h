#pragma once

#include <memory>

#include "sim/film/moving_picture.h"

namespace assay::film {

// Begins an animation in the format WebP, which is repeated without end. Opens the module.
std::unique_ptr<MovingPicture> BeginWebp(const Format& format);

}  // namespace assay::film
