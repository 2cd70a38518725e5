#pragma once

#include <string>
#include <vector>

#include "sim/mujoco/model.h"

namespace CLI {
class App;
}

namespace assay::cli {

// The size of each picture, and how finely it is drawn.
struct PictureQuality {
  std::string size = "960x720";  // pixels, WIDTHxHEIGHT
  int samples = 2;               // samples along each side of a pixel
};

// Adds --size and --samples.
void AddQualityOptions(CLI::App& command, PictureQuality& quality);

// Options for taking pictures.
struct PictureOptions {
  std::vector<std::string> cameras = {};  // empty: the scenario's
  PictureQuality quality = {};
  bool hides_ghosts = false;  // leave out the ghosts of predicted error sets
};

// Adds --camera, --size, --samples and --no-ghosts. `with` names an option of the command without
// which no pictures are taken; it is empty if pictures are always taken.
void AddPictureOptions(CLI::App& command, PictureOptions& options, const std::string& with = "");

// A picture's size in pixels.
struct PictureSize {
  int width = 0;
  int height = 0;

  double aspect() const { return static_cast<double>(width) / height; }
};

// Returns the size in the options. Throws UsageError if it is none.
PictureSize SizeOf(const PictureQuality& quality);

// Returns the camera of the model. Throws UsageError if there is none of this name.
mujoco::CameraId FindCamera(const mujoco::Model& model, const std::string& name);

}  // namespace assay::cli
