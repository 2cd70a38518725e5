#pragma once

#include <filesystem>

#include "sim/render/image.h"

namespace assay::film {

// A file of moving pictures that is being made.
class MovingPicture {
 public:
  virtual ~MovingPicture() = default;

  // Appends a picture that is shown for `duration` seconds. All pictures have the same size.
  virtual void Add(const render::Image& image, double duration) = 0;
  // Writes what is not written yet. No picture can be added after this call. At least one picture
  // must have been added before.
  virtual void Finish() = 0;
};

// The format of a file.
struct Format {
  std::filesystem::path file;  // ends with .webp, or with .mp4 if ffmpeg is installed
  int width = 0;               // pixels
  int height = 0;
  double pictures_per_second = 0;
};

}  // namespace assay::film
