#include "sim/view/page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "planner/plan/certificates/coverage.h"
#include "planner/plan/certificates/not_covered.h"
#include "sim/render/ghost.h"
#include "sim/report/charts/palette.h"
#include "sim/report/html/data_uri.h"
#include "sim/report/html/element.h"
#include "sim/view/bundle.h"
#include "sim/view/error_set_data.h"
#include "sim/view/occurrence_data.h"
#include "sim/view/pose_data.h"
#include "sim/view/recording/recording.h"
#include "sim/view/step_data.h"
#include "sim/view/unproved_way_data.h"

namespace assay::view {
namespace {

using Json = nlohmann::ordered_json;

// A hull has its vertices and, for each facet, the indices of its corners.
Json ShapeData(const Shape& shape) {
  Json data = {{"type", shape.type}};
  if (shape.hull.vertices.empty()) {
    data["size"] = ToJson(shape.size);
  } else {
    data["vertices"] = Json::array();
    data["facets"] = Json::array();
    for (const Vector3& vertex : shape.hull.vertices) data["vertices"].push_back(ToJson(vertex));
    for (const geometry::Facet& facet : shape.hull.facets) data["facets"].push_back(facet.loop);
  }
  data["pose"] = ToJson(shape.X_BodyShape);
  data["color"] = shape.color;
  return data;
}

Json BodiesData(const std::vector<Body>& bodies) {
  Json all = Json::array();
  for (const Body& body : bodies) {
    Json shapes = Json::array();
    for (const Shape& shape : body.shapes) shapes.push_back(ShapeData(shape));
    all.push_back({{"name", body.name}, {"shapes", shapes}});
  }
  return all;
}

Json CamerasData(const scene::Scene& scene) {
  Json all = Json::array();
  for (const Camera& camera : CamerasOf(scene)) {
    all.push_back({{"name", camera.name},
                   {"eye", ToJson(camera.eye)},
                   {"forward", ToJson(camera.forward)},
                   {"up", ToJson(camera.up)},
                   {"angle", camera.vertical_angle}});
  }
  return all;
}

// Returns the parts with the edges of which their outlines are drawn.
Json PartsData(const domain::Problem& problem) {
  Json all = Json::array();
  for (const domain::Part& part : problem.parts) {
    Json edges = Json::array();
    for (const render::Edge& edge : render::EdgesOf(*part.model)) {
      edges.push_back({ToJson(edge.from), ToJson(edge.to)});
    }
    all.push_back({{"name", part.name}, {"body", "part/" + part.name}, {"edges", edges}});
  }
  return all;
}

Json RecordingData(const Recording& recording) {
  return {{"samples", recording.samples},
          {"time", kTimeQuantum},
          {"length", kLengthQuantum},
          {"turn", kTurnQuantum},
          {"force", kForceQuantum},
          {"series", report::DataUri("application/octet-stream", recording.bytes)}};
}

Json ContactPointsData(const ContactSeries& contacts) {
  Json pairs = Json::array();
  for (const TouchingPair& pair : contacts.pairs) {
    pairs.push_back({{"bodies", {pair.bodies.first, pair.bodies.second}}, {"most", pair.most}});
  }
  return {{"pairs", pairs},
          {"position", kContactQuantum},
          {"normal", kNormalQuantum},
          {"force", kForceQuantum},
          {"series", report::DataUri("application/octet-stream", contacts.bytes)}};
}

Json ColorsData() {
  Json colors = Json::object();
  for (const report::Colour& color : report::kPalette)
    colors[std::string(color.name)] = color.light;
  return colors;
}

// The data of one picture of an execution.
Json PictureData(const plan::Plan& plan, const scene::Scene& scene, const execution::Trace& trace) {
  const std::vector<Body> bodies = BodiesOf(scene.model());
  const Recording recording = Record(scene, bodies, trace);
  Json data = {{"bodies", BodiesData(bodies)},
               {"errorSets", ErrorSetsOf(plan, trace)},
               {"collisions", CollisionsOf(trace)},
               {"recording", RecordingData(recording)}};
  if (!recording.contacts.pairs.empty()) {
    data["contactPoints"] = ContactPointsData(recording.contacts);
  }
  return data;
}

Json BesideData(const plan::Plan& plan, const Beside& beside) {
  Json data = PictureData(plan, beside.scene, beside.trace);
  data["name"] = beside.name;
  data["times"] = TimesOf(plan, beside.trace);
  return data;
}

Json TreeData(const std::vector<TreeLine>& lines) {
  Json all = Json::array();
  for (const TreeLine& line : lines) {
    all.push_back({{"depth", line.depth},
                   {"text", line.text},
                   {"action", line.is_action},
                   {"gone", line.is_gone},
                   {"steps", line.steps}});
  }
  return all;
}

void AddWay(const Way& way, Json& data) {
  if (!way.lines.empty()) data["tree"] = TreeData(way.lines);
  if (!way.drawings.empty()) data["drawings"] = way.drawings;
  for (Json& set : RegionsOf(way.actions)) data["errorSets"].push_back(std::move(set));
}

Json DataOf(const Subject& subject) {
  const Executed executed{subject.problem, subject.plan, subject.trace, subject.claims,
                          subject.plan_file};
  Json data = {{"format", "assay-view/1"},
               {"title", subject.problem.name},
               {"source", subject.source},
               {"outcome", {{"name", subject.outcome}, {"reason", subject.reason}}},
               {"notCovered", plan::NotCovered(subject.problem, subject.plan)},
               {"whyNot", WhyNotOf(subject.why_not, subject.problem, subject.scene)},
               {"colors", ColorsData()},
               {"cameras", CamerasData(subject.scene)},
               {"parts", PartsData(subject.problem)},
               {"steps", subject.way ? StepsOf(executed, subject.way->actions) : StepsOf(executed)},
               {"guards", GuardsOf(subject.trace)},
               {"contacts", ContactsOf(subject.trace)},
               {"occurrences", OccurrencesOf(subject.trace)}};
  AddUnprovedWays(subject.problem, subject.plan, subject.scene, data["steps"]);
  data.update(PictureData(subject.plan, subject.scene, subject.trace));
  if (!subject.summary.empty()) data["summary"] = subject.summary;
  if (plan::IsAsPublished(subject.plan)) data["asPublished"] = true;
  if (subject.way) AddWay(*subject.way, data);
  if (subject.beside) data["beside"] = BesideData(subject.plan, *subject.beside);
  return data;
}

// Returns the data as a text that cannot end the HTML script element in which it stands.
std::string ScriptText(const Json& data) {
  std::string text;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    text += c == '<' ? "\\u003c" : std::string(1, c);
  }
  return text;
}

// The policy forbids the browser to fetch anything. Without an icon in the page, a browser would
// ask a server for one.
constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="assay view">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:">
<link rel="icon" href="data:,">
)";

}  // namespace

std::string Page(const Subject& subject) {
  return fmt::format(
      "{}<title>{} – assay view</title>\n</head>\n<body>\n"
      "<noscript>This page needs JavaScript.</noscript>\n"
      "<script type=\"application/json\" id=\"data\">{}</script>\n<script>{}</script>\n"
      "</body>\n</html>\n",
      kHead, report::Escaped(subject.problem.name), ScriptText(DataOf(subject)), Bundle());
}

}  // namespace assay::view
