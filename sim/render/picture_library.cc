#include "sim/render/picture_library.h"

#include "planner/base/module.h"

namespace assay::render {

const PictureLibrary& Pictures() {
  static const PictureLibrary& library =
      Open<PictureLibrary>({.file = "libassay_opencv.so",
                            .entry = "AssayPictureLibrary",
                            .needed_for = "pictures",
                            .debian_packages = "libopencv-imgcodecs406 libopencv-imgproc406"});
  return library;
}

}  // namespace assay::render
