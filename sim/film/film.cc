#include "sim/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/base/check.h"
#include "sim/render/picture.h"
#include "sim/render/work_view.h"

namespace assay::film {
namespace {

constexpr double kLastDuration = 2;  // seconds
constexpr double kFraming = 0.5;     // seconds between the moments that a still camera frames

int CaptionHeight(int height) { return std::max(18, height / 20); }

std::vector<geometry::Pose> TruePoses(const execution::Snapshot& snapshot) {
  std::vector<geometry::Pose> poses;
  for (const execution::TrueAndBelieved& part : snapshot.parts) poses.push_back(part.truth);
  return poses;
}

}  // namespace

Film::Film(const Subject& subject, const Settings& settings)
    : subject_(subject),
      settings_(settings),
      samples_(subject.trace.All<execution::Sample>()),
      captions_(CaptionsOf(subject)),
      data_(subject.scene.Start()),
      renderer_(subject.scene.model(), settings.width,
                settings.height - CaptionHeight(settings.height), {.samples = settings.samples}) {
  ASSAY_CHECK(!samples_.empty() && settings.height >= kLeastHeight);
  ASSAY_CHECK(settings.speed > 0 && settings.pictures_per_second > 0);
  const double shown = subject.trace.end().snapshot.time / settings.speed;
  size_ = static_cast<int>(std::ceil(shown * settings.pictures_per_second)) + 1;
  if (settings.camera.IsNone()) still_ = StillCamera();
}

double Film::Duration(int picture) const {
  return picture + 1 == size_ ? kLastDuration : 1 / settings_.pictures_per_second;
}

double Film::TimeOf(int picture) const {
  const double time = picture * settings_.speed / settings_.pictures_per_second;
  return std::min(time, subject_.trace.end().snapshot.time);
}

void Film::Show(const execution::Snapshot& snapshot) {
  subject_.scene.Show(data_, snapshot.arms, TruePoses(snapshot));
}

render::FreeCamera Film::StillCamera() {
  const std::vector<domain::PartId> parts = WorkedParts(subject_.problem, subject_.plan);
  std::vector<render::Ball> framed;
  double next = 0;
  for (const execution::Sample* sample : samples_) {
    if (sample->snapshot.time < next && sample != samples_.back()) continue;
    next = sample->snapshot.time + kFraming;
    Show(sample->snapshot);
    std::ranges::move(render::WorkOutline(subject_.problem, subject_.scene, parts, data_),
                      std::back_inserter(framed));
  }
  const double aspect =
      static_cast<double>(settings_.width) / (settings_.height - CaptionHeight(settings_.height));
  return render::Framing(framed, render::UsualDirection(), aspect);
}

render::Image Film::Draw(int picture) {
  const double time = TimeOf(picture);
  const auto after = std::ranges::upper_bound(
      samples_, time, {}, [](const execution::Sample* sample) { return sample->snapshot.time; });
  const bool is_last = picture + 1 == size_;
  Show(is_last                     ? subject_.trace.end().snapshot
       : after == samples_.begin() ? samples_.front()->snapshot
                                   : (*std::prev(after))->snapshot);
  const render::Image image = settings_.camera.IsNone() ? renderer_.Render(data_, still_)
                                                        : renderer_.Render(data_, settings_.camera);
  const std::string text = is_last ? captions_.back().text : TextAt(captions_, time);
  return render::WithCaption(
      image, {text, fmt::format("{:.1f} s", time), CaptionHeight(settings_.height)});
}

}  // namespace assay::film
