#pragma once

#include <string>
#include <vector>

#include "sim/film/captions.h"
#include "sim/film/subject.h"
#include "sim/mujoco/data.h"
#include "sim/render/renderer.h"

namespace assay::film {

struct Settings {
  // The camera of the model. None: a camera that stands where it sees the parts and the hand during
  // the whole execution.
  mujoco::CameraId camera = {};
  int width = 960;  // pixels, of the whole picture with its caption
  int height = 720;
  int samples = 2;  // samples along each side of a pixel
  double pictures_per_second = 10;
  double speed = 1;  // simulated seconds in a second of the film
};

// The least height of a film's pictures, pixels.
inline constexpr int kLeastHeight = 60;

// A film of an execution. Each picture shows the sample that is nearest to its time, with the step
// and the time below. Nothing is simulated. Equal subjects and settings give equal pictures on one
// machine. A film must be used by the thread that made it.
class Film {
 public:
  // Throws EnvironmentError if there is no renderer. The objects that `subject` refers to must
  // outlive the film.
  Film(const Subject& subject, const Settings& settings);

  // Returns the number of pictures, at least 1. The last one shows the end of the execution.
  int size() const { return size_; }
  // Returns how long a picture is shown, seconds. The last one is shown longer.
  double Duration(int picture) const;
  render::Image Draw(int picture);

 private:
  double TimeOf(int picture) const;  // simulated seconds
  void Show(const execution::Snapshot& snapshot);
  render::FreeCamera StillCamera();

  Subject subject_;
  Settings settings_;
  std::vector<const execution::Sample*> samples_;
  std::vector<Caption> captions_;
  int size_ = 0;
  mujoco::Data data_;
  render::Renderer renderer_;
  render::FreeCamera still_;
};

}  // namespace assay::film
