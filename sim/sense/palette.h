#pragma once

#include <cstdint>
#include <vector>

#include "sim/render/image.h"
#include "sim/scene/scene.h"

namespace assay::sense {

using domain::PartId;

// The kind of surface that a pixel shows, judged by its colour.
enum class Surface : std::uint8_t {
  kElse,       // robot, floor, or a pixel too dark to judge
  kTable,      // the table, or something of its colour
  kPart,       // the part that is looked for, or another part of its colour
  kOtherPart,  // a part of another colour
};

// The surface that each pixel of a square picture shows, in rows from the top.
struct SurfaceMap {
  int size = 0;  // pixels along each side
  std::vector<Surface> surfaces;

  // Returns the surface of the pixel that holds this point; kElse outside the picture.
  Surface At(double x, double y) const;
};

// The colours of everything in the scene.
class Palette {
 public:
  explicit Palette(const scene::Scene& scene);

  // Returns the surfaces of the image in a search for `part`. Surfaces are distinguished by hue and
  // saturation, so that shading, shadows and brightness do not matter. The image must be square
  // (checked).
  SurfaceMap Segment(const render::Image& image, PartId part) const;

 private:
  struct Entry {
    float red = 0;                   // share of the sum of red, green and blue
    float green = 0;                 // share of the same sum
    std::vector<PartId> parts = {};  // the parts of this colour
    bool is_table = false;
  };

  void Add(const float* rgba, PartId part, bool is_table);
  static Surface SurfaceOf(const Entry& entry, PartId part);
  Surface SurfaceIn(const std::uint8_t* rgb, PartId part) const;

  std::vector<Entry> entries_;
};

}  // namespace assay::sense
