#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/render/image.h"

namespace assay::film {

// Encodes one animation.
class WebpEncoder {
 public:
  virtual ~WebpEncoder() = default;

  // Appends a picture of the film that is shown from this time on, milliseconds. Returns whether
  // that worked.
  virtual bool Add(const render::Image& image, int from) = 0;
  // Returns the bytes of the film's file, whose last picture ends at this time, milliseconds; none
  // if that failed.
  virtual std::vector<std::uint8_t> Finish(int end) = 0;
};

// What the module sim/webp implements with libwebp.
class WebpLibrary {
 public:
  virtual ~WebpLibrary() = default;

  // Returns an encoder of a film, or nothing if there is none for pictures of this size.
  virtual std::unique_ptr<WebpEncoder> Begin(int width, int height) const = 0;
};

}  // namespace assay::film
