#include "sim/cli/picture_output/step_pictures.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <optional>

#include "planner/plan/data/tool_route.h"
#include "sim/cli/picture_output/ghosts.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/film/subject.h"
#include "sim/render/picture.h"
#include "sim/render/work_view.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {
namespace {

constexpr const char* kContactSheet = "contact-sheet.png";

// Returns "judge-can1-can2" for "judge(can1, can2)".
std::string FileName(const std::string& action) {
  std::string name;
  for (const char c : action) {
    if (c == '(' || c == ',') name += '-';
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') name += c;
  }
  if (name.ends_with('-')) name.pop_back();  // for an action without arguments
  return name;
}

}  // namespace

StepPictures::StepPictures(const PicturedPlan& subject,
                           const std::vector<std::string>& cameras_of_scenario,
                           const PictureOptions& options)
    : problem_(subject.problem),
      plan_(subject.plan),
      scene_(subject.scene),
      hides_ghosts_(options.hides_ghosts),
      size_(SizeOf(options.quality)),
      renderer_(scene_.model(), size_.width, size_.height, {.samples = options.quality.samples}),
      cameras_(options.cameras.empty() ? cameras_of_scenario : options.cameras),
      worked_(film::WorkedParts(problem_, plan_)) {
  for (const std::string& camera : cameras_) {
    if (camera != scenario::kWorkCamera) FindCamera(scene_.model(), camera);
  }
}

render::Image StepPictures::Shot(const std::string& camera, const mujoco::Data& data,
                                 std::span<const render::Ghost> ghosts) {
  if (camera != scenario::kWorkCamera) {
    return renderer_.Render(data, FindCamera(data.model(), camera), ghosts);
  }
  return renderer_.Render(data, render::WorkView(problem_, scene_, worked_, data, size_.aspect()),
                          ghosts);
}

void StepPictures::Take(const std::string& name, const std::string& caption,
                        const mujoco::Data& data, std::span<const render::Ghost> ghosts) {
  for (const std::string& camera : cameras_) {
    const bool first = camera == cameras_.front();
    const std::string suffix = first ? "" : "-" + camera;
    pictures_.push_back(
        {fmt::format("{:02}-{}{}.png", ended_, name, suffix), Shot(camera, data, ghosts)});
    if (first) sheet_.push_back({caption, pictures_.back().image});
  }
  close_ups_ = 0;
}

void StepPictures::SeeStart(const mujoco::Data& data) { Take("start", "start", data, {}); }

void StepPictures::TakeStepEnd(const std::string& action, const mujoco::Data& data) {
  ++ended_;
  Take(FileName(action), fmt::format("{} {}", ended_, action), data, {});
}

void StepPictures::TakeCloseUp(const plan::PlannedStep& step, const Snapshot& snapshot,
                               const render::FreeCamera& camera, const mujoco::Data& data) {
  const int number = ended_ + 1;
  pictures_.push_back(
      {fmt::format("{:02}-{}-{}-{}.png", number, step.name, ++close_ups_, snapshot.name),
       renderer_.Render(data, camera)});
  sheet_.push_back({fmt::format("{} {}", number, snapshot.caption), pictures_.back().image});
}

void StepPictures::TakeGrasp(const plan::PlannedStep& step, const mujoco::Data& data) {
  const domain::PartId part = plan::PlacedPart(problem_, step.action);
  const render::FreeCamera camera = render::CloseUp(render::GraspOf(problem_, scene_, part, data),
                                                    render::Sight(data), size_.aspect());
  const std::string caption = fmt::format("pads closed on {}", problem_.part(part).name);
  TakeCloseUp(step, {"closed", caption}, camera, data);
}

void StepPictures::TakeMating(const std::optional<Snapshot>& snapshot, const mujoco::Data& data) {
  if (snapshot) TakeCloseUp(plan_.step(mating_step_), *snapshot, mating_->camera(), data);
}

void StepPictures::SeeTimestep(const mujoco::Data& data) {
  if (mating_) TakeMating(mating_->Look(data), data);
}

void StepPictures::SeeMilestone(const execution::Milestone& milestone, const mujoco::Data& data) {
  const plan::PlannedStep& step = plan_.step(milestone.step);
  const bool acted = milestone.stage == execution::Stage::kActed;
  if (const domain::MatingId mating = step.action.mating; !mating.IsNone()) {
    if (acted) TakeMating(mating_->LookAtRest(data), data);
    if (milestone.stage != execution::Stage::kPoised) return;
    mating_.emplace(problem_, scene_, problem_.mating(mating), data, size_.aspect());
    mating_step_ = milestone.step;
    return;
  }
  if (acted && step.action.kind->ClosesPads()) TakeGrasp(step, data);
}

void StepPictures::SeeStepEnd(const execution::StepEnd& end, const mujoco::Data& data) {
  // After a recovery the part rests in another place than before.
  if (mating_) TakeMating(mating_->LookAtRest(data), data);
  mating_.reset();
  ++ended_;
  std::vector<render::Ghost> ghosts;
  if (!hides_ghosts_) ghosts = GhostsAfter(problem_, plan_.step(end.step), end.snapshot);
  has_ghosts_ = has_ghosts_ || !ghosts.empty();
  Take(end.name, fmt::format("{} {}", ended_, end.action), data, ghosts);
}

void StepPictures::Write(const std::filesystem::path& folder) const {
  if (sheet_.empty()) return;  // if interrupted before the start
  for (const Picture& picture : pictures_) {
    WriteFile(folder / picture.file, render::EncodedPng(picture.image));
  }
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(sheet_.size()))));
  std::vector<render::LegendEntry> legend;
  if (has_ghosts_) legend.push_back({render::kPredicted, "ghosts: predicted error set"});
  WriteFile(folder / kContactSheet,
            render::EncodedPng(render::ContactSheet(sheet_, columns, legend)));
}

std::vector<std::string> StepPictures::FileNames() const {
  std::vector<std::string> names;
  for (const Picture& picture : pictures_) names.push_back(picture.file);
  names.push_back(kContactSheet);
  return names;
}

}  // namespace assay::cli
