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

  // Appends a picture of the film. It is shown from the time `from` on, in milliseconds. Returns
  // whether the picture was appended.
  virtual bool Add(const render::Image& image, int from) = 0;
  // Returns the bytes of the film's file. Its last picture ends at the time `end`, in milliseconds.
  // Returns no bytes if the encoder failed.
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
