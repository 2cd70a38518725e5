#include "sim/report/fine_motion/mating_page.h"

#include <fmt/format.h>

#include "sim/report/html/data_uri.h"
#include "sim/report/html/head.h"

namespace assay::report {
namespace {

// If the window is wide enough, the table is beside the graph, and pictures are side by side.
constexpr const char* kMatingRules = R"css(
.beside { display: flex; flex-wrap: wrap; gap: 1.5rem; align-items: flex-start; }
.graphs { flex: 1 1 34rem; min-width: 0; }
.graphs figure { margin: .6rem 0; }
.beside .scroll { flex: 1 1 26rem; }
.contacts { max-width: 100%; height: auto; }
.states { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: 1rem; }
.states figure { margin: 0; }
)css";

Element Graphs(std::vector<Element> pictures) {
  Element graphs("div");
  graphs.Set("class", "graphs");
  int number = 0;
  for (Element& picture : pictures) {
    Element& figure = graphs.Add("figure");
    figure.Add("div").Set("class", "scroll").Add(std::move(picture));
    figure.Add("figcaption", fmt::format("Critical point {}", ++number));
  }
  graphs
      .Add("p",
           "Contact states at each critical point, with a row for each dimension. A line joins two "
           "states if one contact is made or broken between them. Blue states are those in which "
           "the way begins, and green states are goals. States of the crevice between two critical "
           "points are goals of the first graph and beginnings of the second. Rings are states of "
           "the plan, joined in their order and numbered by the motions that end in them. Rings "
           "beside the graph exist only if the part is tilted. Point at a state to read its "
           "contacts and its number of transitions to a goal.")
      .Set("class", "note");
  return graphs;
}

using Row = std::vector<std::string>;  // the first entry is the row's name

Element TableOf(const char* caption, const Row& names, const std::vector<Row>& rows) {
  Element frame("div");
  frame.Set("class", "scroll");
  Element& table = frame.Add("table");
  table.Add("caption").Add("span", caption);
  Element& head = table.Add("thead").Add("tr");
  for (const std::string& name : names) head.Add("th", name).Set("scope", "col");
  Element& body = table.Add("tbody");
  for (const Row& texts : rows) {
    Element& row = body.Add("tr");
    row.Add("th", texts.front()).Set("scope", "row");
    for (std::size_t i = 1; i < texts.size(); ++i) row.Add("td", texts[i]);
  }
  return frame;
}

Element Motions(const std::vector<MatingSubject::Motion>& motions) {
  std::vector<Row> rows;
  for (const MatingSubject::Motion& motion : motions) {
    rows.push_back(
        {fmt::format("{}", rows.size() + 1), motion.ends_with, motion.contacts, motion.unwanted});
  }
  return TableOf("Motions of the strategy",
                 {"", "ends with", "in contact at its end", "first unwanted contact"}, rows);
}

Element Ranked(const std::vector<MatingSubject::Trials::Ranked>& contacts) {
  std::vector<Row> rows;
  for (const auto& ranked : contacts)
    rows.push_back({ranked.contact, ranked.motion, ranked.scale, ranked.happened});
  return TableOf("Unwanted contacts, by their margins",
                 {"contact", "motion", "times the errors", "happened in trials"}, rows);
}

Element States(const std::vector<MatingSubject::Picture>& pictures) {
  Element states("div");
  states.Set("class", "states");
  for (const MatingSubject::Picture& picture : pictures) {
    Element& figure = states.Add("figure");
    figure.Add("img").Set("src", DataUri("image/png", picture.png)).Set("alt", picture.caption);
    figure.Add("figcaption", picture.caption);
  }
  return states;
}

}  // namespace

std::string MatingPage(MatingSubject subject) {
  Element page("html");
  Element& head = page.Set("lang", "en").Add(Head(subject.title));
  head.Add("style", kMatingRules);
  Element& body = page.Add("body");
  Element& header = body.Add("header");
  header.Add("h1", subject.title);
  header.Add("p", subject.summary).Set("class", "about");
  Element& main = body.Add("main");
  Element& beside = main.Add("div").Set("class", "beside");
  beside.Add(Graphs(std::move(subject.graphs)));
  beside.Add(Motions(subject.motions));
  main.Add("h2", "Where the motions end");
  main.Add("p",
           "The pictures show the motions without errors. The held part is drawn as lines, and "
           "crosses mark where the parts touch.")
      .Set("class", "note");
  main.Add(States(subject.pictures));
  if (const auto& trials = subject.trials) {
    main.Add("h2", "Trials in physics");
    main.Add("p", trials->outcome);
    main.Add("p", trials->ranking);
    main.Add(Ranked(trials->contacts));
  }
  return "<!DOCTYPE html>\n" + page.Markup() + "\n";
}

}  // namespace assay::report
