#include "sim/view/why_not_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "planner/domain/units/units.h"
#include "sim/view/pose_data.h"
#include "sim/view/stage.h"

namespace assay::view {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

// Draws situations of one scene.
class SituationData {
 public:
  SituationData(const domain::Problem& problem, const scene::Scene& scene)
      : problem_(problem), scene_(scene), bodies_(BodiesOf(scene.model())), data_(scene.Start()) {
    for (std::size_t i = 0; i < problem.workcell->robots().size(); ++i) {
      at_home_.push_back(scene.Posture(data_, domain::RobotId(i)));
    }
  }

  Json Of(const plan::Situation& situation) {
    marked_.clear();
    ghosts_ = Json::array();
    for (const plan::NamedBody& named : situation.colliding) Mark(NamesOf(named));
    for (const domain::PlacedPart& part : situation.parts) AddPart(part);
    if (situation.hand) AddHand(*situation.hand);
    Json data = {{"marked", marked_}, {"ghosts", ghosts_}};
    if (situation.excess) {
      data["excess"] = {{"unit", domain::SiUnitOf(situation.excess->dimension).name},
                        {"value", situation.excess->value},
                        {"limit", situation.excess->limit}};
    }
    return data;
  }

 private:
  void Mark(const Names& names) { marked_.insert(marked_.end(), names.begin(), names.end()); }

  Names NamesOf(const plan::NamedBody& named) const {
    if (!named.part.IsNone()) return {"part/" + problem_.part(named.part).name};
    if (named.robot.IsNone()) return {};
    const std::string gripper = PrefixOf(named.robot) + "gripper/";
    if (named.piece == "hand") return {gripper + "hand"};
    if (named.piece == "fingers") return {gripper + "finger_left", gripper + "finger_right"};
    return {PrefixOf(named.robot) + "arm/" + named.piece};
  }
  std::string PrefixOf(domain::RobotId robot) const {
    return problem_.workcell->robots()[robot.index()].Prefix();
  }

  void AddGhost(const std::string& body, const Pose& pose) {
    ghosts_.push_back({{"body", body}, {"pose", ToJson(pose)}});
  }

  // A part at its start pose is marked and needs no ghost.
  void AddPart(const domain::PlacedPart& part) {
    const std::string body = "part/" + problem_.part(part.part).name;
    if (part.X_WorldPart.isApprox(problem_.part(part.part).X_WorldPart)) {
      marked_.push_back(body);
    } else {
      AddGhost(body, part.X_WorldPart);
    }
  }

  // Without a posture of the arm, the hand is drawn alone.
  void AddHand(const plan::PlacedHand& hand) {
    std::vector<scene::ArmPosture> arms = at_home_;
    scene::ArmPosture& arm = arms[hand.robot.index()];
    arm = {hand.posture.value_or(arm.q), hand.opening};
    scene_.Show(data_, arms, {});
    const scene::Scene of_robot = scene_.WorkedBy(hand.robot);
    const Pose X_WorldShift = hand.X_WorldTool * of_robot.ToolPose(data_).inverse();
    for (const Body& body : bodies_) {
      const bool is_of_hand = body.name.starts_with(PrefixOf(hand.robot) + "gripper/");
      const bool is_of_arm = body.name.starts_with(PrefixOf(hand.robot) + "arm/");
      if (is_of_hand) AddGhost(body.name, X_WorldShift * data_.BodyPose(body.id));
      if (is_of_arm && hand.posture) AddGhost(body.name, data_.BodyPose(body.id));
    }
  }

  const domain::Problem& problem_;
  const scene::Scene& scene_;
  const std::vector<Body> bodies_;
  mujoco::Data data_;
  std::vector<scene::ArmPosture> at_home_;
  Names marked_;
  Json ghosts_;
};

}  // namespace

Json WhyNotOf(const std::vector<Reasons>& why_not, const domain::Problem& problem,
              const scene::Scene& scene) {
  SituationData situations(problem, scene);
  Json all = Json::array();
  for (const auto& [title, reasons] : why_not) {
    Json list = Json::array();
    for (const plan::Reason& reason : reasons) {
      Json data = {{"text", reason.text}};
      if (reason.situation) data.update(situations.Of(*reason.situation));
      list.push_back(std::move(data));
    }
    all.push_back({{"title", title}, {"reasons", std::move(list)}});
  }
  return all;
}

}  // namespace assay::view
