#include "planner/plan/plan_files/strategy_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/domain/units/units.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/plan_files/pose_file.h"

namespace assay::plan {
namespace {

using geometry::Vector3;
using Json = nlohmann::ordered_json;

// Words for UnwantedContact::is_loss: false, true.
const std::vector<std::string> kHappenings = {"made", "lost"};

Json ContactToJson(const StrategyContact& contact) {
  return {{"name", contact.name},
          {"normal", VectorToJson(contact.normal)},
          {"at", VectorToJson(contact.at)}};
}

Json UnwantedToJson(const UnwantedContact& unwanted) {
  Json json = {{"contact", unwanted.contact},
               {"is", kHappenings[unwanted.is_loss ? 1 : 0]},
               {"scale", unwanted.scale},
               {"gap", unwanted.gap},
               {"separation", unwanted.separation}};
  if (const auto& likely = unwanted.likely)
    json["likely"] = {{"d", VectorToJson(likely->d)}, {"w", VectorToJson(likely->w)}};
  return json;
}

Json MotionToJson(const StrategyMotion& motion) {
  Json json = {{"kept", motion.kept}, {"X_FixedTip", PoseToJson(motion.X_FixedTip)}};
  if (motion.until) json["until"] = *motion.until;
  json["beyond"] = motion.beyond;
  json["slides"] = motion.slides;
  json["unwanted"] = Json::array();
  for (const UnwantedContact& u : motion.unwanted) json["unwanted"].push_back(UnwantedToJson(u));
  return json;
}

Json CertificateToJson(const StrategyCertificate& certificate) {
  Json absorbs = Json::array();
  for (const Condition condition : certificate.absorbs) absorbs.push_back(condition.name());
  return {{"absorbs", absorbs},
          {"d", VectorToJson(certificate.d)},
          {"w", VectorToJson(certificate.w)},
          {"velocity", certificate.velocity},
          {"friction", certificate.friction},
          {"absorbed", certificate.absorbed}};
}

double ReadAtLeastZero(const Value& value, const domain::Unit& unit = domain::kRatio) {
  return domain::ReadWithin(value, unit, domain::kAtLeastZero);
}

Vector3 ReadHalfWidths(const Value& value, const domain::Unit& unit) {
  for (const Value& item : value.Items()) ReadAtLeastZero(item, unit);
  return ReadVector(value);
}

StrategyContact ReadContact(const Value& value) {
  value.AllowOnly({"name", "normal", "at"});
  const Value normal = value.At("normal");
  StrategyContact contact = {value.At("name").Text(), ReadVector(normal),
                             ReadVector(value.At("at"))};
  if (std::abs(contact.normal.norm() - 1) > kUnit) {
    normal.Fail(fmt::format("a normal of length {:.6g}", contact.normal.norm()), "length 1");
  }
  return contact;
}

int ReadContactIndex(const Value& value, std::size_t contacts) {
  if (contacts == 0) value.Fail("the strategy has no contacts");
  return value.Integer(0, static_cast<int>(contacts) - 1);
}

TipError ReadTipError(const Value& value) {
  value.AllowOnly({"d", "w"});
  return {ReadVector(value.At("d")), ReadVector(value.At("w"))};
}

UnwantedContact ReadUnwanted(const Value& value, std::size_t contacts) {
  value.AllowOnly({"contact", "is", "scale", "gap", "separation", "likely"});
  const Value separation = value.At("separation");
  UnwantedContact unwanted{.contact = ReadContactIndex(value.At("contact"), contacts),
                           .is_loss = value.At("is").OneOf(kHappenings) == 1,
                           .scale = ReadAtLeastZero(value.At("scale")),
                           .gap = value.At("gap").Number(),
                           .separation = ReadAtLeastZero(separation)};
  if (unwanted.separation > 1)
    separation.Fail(fmt::format("{} is above 1", separation.Text()), "0 .. 1");
  if (const auto likely = value.Find("likely")) unwanted.likely = ReadTipError(*likely);
  return unwanted;
}

StrategyMotion ReadMotion(const Value& value, std::size_t contacts) {
  value.AllowOnly({"kept", "X_FixedTip", "until", "beyond", "slides", "unwanted"});
  StrategyMotion motion{.kept = {}, .X_FixedTip = ReadPose(value.At("X_FixedTip")), .until = {}};
  for (const Value& kept : value.At("kept").Items()) {
    motion.kept.push_back(ReadContactIndex(kept, contacts));
  }
  if (const auto until = value.Find("until")) motion.until = ReadContactIndex(*until, contacts);
  motion.beyond = ReadAtLeastZero(value.At("beyond"));
  motion.slides = value.At("slides").Flag();
  for (const Value& unwanted : value.At("unwanted").Items()) {
    motion.unwanted.push_back(ReadUnwanted(unwanted, contacts));
  }
  return motion;
}

StrategyCertificate ReadStrategyCertificate(const Value& value) {
  value.AllowOnly({"absorbs", "d", "w", "velocity", "friction", "absorbed"});
  StrategyCertificate certificate;
  const ConditionKinds kinds = KnownConditions();
  for (const Value& name : value.At("absorbs").Items()) {
    const int kind = name.OneOf(NamesOfConditions(kinds));
    certificate.absorbs.emplace_back(*kinds[static_cast<std::size_t>(kind)]);
  }
  certificate.d = ReadHalfWidths(value.At("d"), domain::kMetres);
  certificate.w = ReadHalfWidths(value.At("w"), domain::kRadians);
  certificate.velocity = ReadAtLeastZero(value.At("velocity"));
  certificate.friction = ReadAtLeastZero(value.At("friction"));
  certificate.absorbed = ReadAtLeastZero(value.At("absorbed"));
  return certificate;
}

}  // namespace

Json ToJson(const Strategy& strategy) {
  Json json = {{"X_HeldTip", PoseToJson(strategy.X_HeldTip)},
               {"X_FixedStart", PoseToJson(strategy.X_FixedStart)},
               {"contacts", Json::array()},
               {"motions", Json::array()}};
  for (const StrategyContact& c : strategy.contacts) json["contacts"].push_back(ContactToJson(c));
  for (const StrategyMotion& m : strategy.motions) json["motions"].push_back(MotionToJson(m));
  json["friction"] = strategy.friction;
  json["length"] = strategy.length;
  json["certificate"] = CertificateToJson(strategy.certificate);
  return json;
}

Strategy ReadStrategy(const Value& value) {
  value.AllowOnly(
      {"X_HeldTip", "X_FixedStart", "contacts", "motions", "friction", "length", "certificate"});
  const Value length = value.At("length");
  Strategy strategy{.X_HeldTip = ReadPose(value.At("X_HeldTip")),
                    .X_FixedStart = ReadPose(value.At("X_FixedStart")),
                    .contacts = {},
                    .motions = {},
                    .friction = ReadAtLeastZero(value.At("friction")),
                    .length = ReadAtLeastZero(length, domain::kMetres),
                    .certificate = ReadStrategyCertificate(value.At("certificate"))};
  if (strategy.length == 0) length.Fail("0 m is no length", "more than 0 m");
  for (const Value& contact : value.At("contacts").Items()) {
    strategy.contacts.push_back(ReadContact(contact));
  }
  const std::vector<Value> motions = value.At("motions").Items();
  if (motions.empty()) value.At("motions").Fail("a strategy without motions", "at least one");
  for (const Value& motion : motions) {
    strategy.motions.push_back(ReadMotion(motion, strategy.contacts.size()));
  }
  return strategy;
}

}  // namespace assay::plan
