#pragma once

#include <cstdint>
#include <vector>

#include "sim/render/image.h"
#include "sim/scene/scene.h"

namespace assay::sense {

using domain::PartId;

// What a pixel shows, by its colour.
enum class Surface : std::uint8_t {
  kElse,       // robot, floor; too dark to tell
  kTable,      // or what has its colour
  kPart,       // the part that is looked for, or another of its colour
  kOtherPart,  // of another colour
};

// A picture of what each pixel shows, rows from the top.
struct SurfaceMap {
  int size = 0;  // pixels along each side
  std::vector<Surface> surfaces;

  // Of the pixel that holds this point; kElse outside of the picture.
  Surface At(double x, double y) const;
};

// The colours of all that the scene shows.
class Palette {
 public:
  explicit Palette(const scene::Scene& scene);

  // Tells surfaces apart by hue and saturation: shading, shadows and brightness of the light do
  // not matter. The image must be square (checked).
  SurfaceMap Segment(const render::Image& image, PartId part) const;

 private:
  struct Entry {
    float red = 0;  // of the sum of red, green and blue
    float green = 0;
    std::vector<PartId> parts = {};  // which have this colour
    bool is_table = false;
  };

  void Add(const float* rgba, PartId part, bool is_table);
  static Surface SurfaceOf(const Entry& entry, PartId part);
  Surface SurfaceIn(const std::uint8_t* rgb, PartId part) const;

  std::vector<Entry> entries_;
};

}  // namespace assay::sense
