#include "sim/cli/picture_output/contact_pictures.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/geometry/pose.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/render/picture.h"
#include "sim/render/renderer.h"

namespace assay::cli {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr int kPictureWidth = 640;
constexpr int kPictureHeight = 480;
constexpr double kDistance = 0.25;  // metres from the eye to the tip
constexpr double kAngle = 0.35;     // radians, over the height of the picture
constexpr double kArm = 0.003;      // metres; the arm of a cross
constexpr double kOutOfSight = -2;  // metres
// Colours that stand out against any colour of the fixed part and in the dark of its hole.
constexpr render::Colour kHeld{"#ffd24a"};
constexpr render::Colour kTouching{"#ff5a4d"};

// Returns a camera that looks from the side by which the part goes in, and from above.
render::FreeCamera CameraOn(const Vector3& tip, const Vector3& out) {
  const Vector3 aside = out.cross(out.unitOrthogonal() + 0.3 * Vector3::UnitZ()).normalized();
  const Vector3 back = (out + 0.7 * aside + 0.3 * Vector3::UnitZ()).normalized();
  const Vector3 right = Vector3::UnitZ().cross(back).normalized();
  Pose X_WorldCamera = Pose::Identity();
  X_WorldCamera.linear() << right, back.cross(right), back;
  X_WorldCamera.translation() = tip + kDistance * back;
  return {X_WorldCamera, kAngle};
}

// Returns a cross of lines whose faces are turned to the eye.
render::Ghost Cross(const Vector3& at, const Vector3& eye) {
  render::Ghost cross{.colour = kTouching};
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 arm = kArm * Vector3::Unit(axis);
    cross.edges.push_back({at - arm, at + arm, eye - at});
  }
  return cross;
}

// Returns a label at the place in the picture where the camera sees a point.
render::Label LabelAt(const Vector3& point, const render::FreeCamera& camera,
                      const std::string& text) {
  const Vector3 p = camera.X_WorldCamera.inverse() * point;
  const double scale = kPictureHeight / 2.0 / std::tan(camera.vertical_angle / 2) / -p.z();
  return {.text = text,
          .x = kPictureWidth / 2.0 + scale * p.x(),
          .y = kPictureHeight / 2.0 - scale * p.y(),
          .colour = kTouching};
}

std::string CaptionOf(int number, const plan::Strategy& strategy,
                      const std::vector<int>& contacts) {
  std::vector<std::string> names;
  for (const int contact : contacts)
    names.push_back(strategy.contacts[static_cast<std::size_t>(contact)].name);
  return fmt::format("{}: {}", number,
                     names.empty() ? "no contact" : fmt::format("{}", fmt::join(names, ", ")));
}

void Write(const render::Image& image, const std::filesystem::path& file) {
  WriteFile(file, render::EncodedPng(image));
}

}  // namespace

std::vector<ContactPicture> WriteContactPictures(const std::filesystem::path& folder,
                                                 const domain::Problem& problem,
                                                 const scene::Scene& scene,
                                                 const domain::Mating& mating,
                                                 const plan::Strategy& strategy) {
  mujoco::Data data = scene.Start();
  scene.SetPart(data, mating.held, geometry::Translation(0, 0, kOutOfSight));
  data.Forward();
  const Pose X_WorldFixed = scene.TruePose(data, mating.fixed);
  const Vector3 out = -(X_WorldFixed.linear() * mating.mating_vector.normalized());
  const plan::StrategyMotion& entered = strategy.motions[strategy.motions.size() - 2];
  const render::FreeCamera camera = CameraOn(X_WorldFixed * entered.X_FixedTip.translation(), out);
  render::Renderer renderer(scene.model(), kPictureWidth, kPictureHeight);
  std::vector<ContactPicture> files;
  std::vector<render::CaptionedImage> sheet;
  for (const plan::StrategyMotion& motion : strategy.motions) {
    const std::vector<int> contacts = plan::ContactsAfter(motion);
    const Pose X_WorldHeld = X_WorldFixed * motion.X_FixedTip * strategy.X_HeldTip.inverse();
    std::vector<render::Ghost> lines = {
        render::GhostOf(*problem.part(mating.held).model, X_WorldHeld, kHeld)};
    std::vector<render::Label> labels;
    for (const int index : contacts) {
      const auto& contact = strategy.contacts[static_cast<std::size_t>(index)];
      const Vector3 at = X_WorldFixed * (motion.X_FixedTip.translation() + contact.at);
      lines.push_back(Cross(at, camera.X_WorldCamera.translation()));
      labels.push_back(LabelAt(at, camera, contact.name));
    }
    const int number = static_cast<int>(sheet.size()) + 1;
    sheet.push_back({CaptionOf(number, strategy, contacts),
                     render::WithLabels(renderer.Render(data, camera, lines), labels)});
    files.push_back({fmt::format("{:02}-contacts.png", number), sheet.back().caption});
    Write(sheet.back().image, folder / files.back().file);
  }
  files.push_back({"contact-sheet.png", "all of them"});
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(sheet.size()))));
  Write(
      render::ContactSheet(sheet, columns, {{kHeld, "held part"}, {kTouching, "where it touches"}}),
      folder / files.back().file);
  return files;
}

}  // namespace assay::cli
