#include "sim/report/fine_motion/contact_graph_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "sim/report/fine_motion/mating_page.h"
#include "tests/sim/report/markup.h"

namespace assay::report::contact_graph_picture_test {
namespace {

using finemotion::ContactKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

finemotion::ContactKey OnFace(int vertex) { return {ContactKind::kVertexFace, vertex, 0}; }

finemotion::ContactState StateOf(std::vector<int> contacts, std::vector<int> parents,
                                 std::vector<int> sons) {
  const int dimension = 6 - static_cast<int>(contacts.size());
  return {.contacts = std::move(contacts),
          .dimension = dimension,
          .target_points = {},
          .parents = std::move(parents),
          .sons = std::move(sons)};
}

// Returns the topology of two contacts. Each of them can be made alone, and both together.
finemotion::LocalTopology TwoContacts() {
  finemotion::LocalTopology topology;
  for (const int vertex : {1, 2}) {
    finemotion::PrimitiveContact& contact = topology.space.contacts.emplace_back();
    contact.kind = ContactKind::kVertexFace;
    contact.moving = vertex;
  }
  topology.graph.states = {StateOf({}, {}, {1, 2}), StateOf({0}, {0}, {3}), StateOf({1}, {0}, {3}),
                           StateOf({0, 1}, {1, 2}, {})};
  topology.initial = {0};
  topology.goals = {3};
  topology.graph.MeasureTo(topology.goals);
  return topology;
}

check::PlannedContacts Through(std::vector<check::ContactSet> after) {
  check::PlannedContacts planned;
  check::ContactSet before;
  for (check::ContactSet& contacts : after) {
    planned.motions.push_back({.before = before, .after = contacts});
    before = contacts;
  }
  return planned;
}

Markup Drawn(const check::PlannedContacts& planned, const MotionRange& motions) {
  return ReadMarkup("<!DOCTYPE html>\n" +
                    ContactGraphPicture(TwoContacts(), planned, motions).Markup());
}

Markup Drawn(const check::PlannedContacts& planned) {
  return Drawn(planned, {0, planned.motions.size()});
}

std::vector<const Markup*> OfClass(const Markup& picture, const std::string& name) {
  std::vector<const Markup*> found;
  for (const char* element : {"circle", "path", "text"}) {
    for (const Markup* child : picture.All(element)) {
      const auto kind = child->attributes.find("class");
      if (kind != child->attributes.end() && kind->second == name) found.push_back(child);
    }
  }
  return found;
}

// Returns the tooltip of an element.
std::string TitleOf(const Markup& element) { return element.All("title").at(0)->text; }

TEST(ContactGraphPicture, HasADotForEachStateInTheRowOfItsDimension) {
  const Markup picture = Drawn({});
  std::map<std::string, std::set<std::string>> rows;
  for (const Markup* dot : OfClass(picture, "state"))
    rows[dot->attributes.at("cy")].insert(TitleOf(*dot));
  ASSERT_EQ(rows.size(), 3u);
  std::set<std::set<std::string>> states;
  for (const auto& [y, names] : rows) states.insert(names);
  EXPECT_EQ(states, (std::set<std::set<std::string>>{
                        {"free; 2 to a goal"},
                        {"vertex 1 on face 0; 1 to a goal", "vertex 2 on face 0; 1 to a goal"},
                        {"vertex 1 on face 0, vertex 2 on face 0; 0 to a goal"},
                    }));
}

// Each line is drawn once. Lines join the free state to each contact, and each contact to both.
TEST(ContactGraphPicture, JoinsNeighbours) {
  const Markup picture = Drawn({});
  const std::string lines = OfClass(picture, "neighbour").at(0)->attributes.at("d");
  EXPECT_EQ(std::ranges::count(lines, 'M'), 4);
}

TEST(ContactGraphPicture, NumbersThePlansStates) {
  const Markup picture =
      Drawn(Through({{OnFace(2)}, {OnFace(1), OnFace(2)}, {OnFace(1), OnFace(2)}, {OnFace(2)}}));
  std::vector<std::string> numbers;
  for (const Markup* text : OfClass(picture, "numbers")) numbers.push_back(text->text);
  EXPECT_THAT(numbers, ElementsAre("start", "1, 4", "2–3"));
  std::vector<std::string> titles;
  for (const Markup* ring : OfClass(picture, "planned")) titles.push_back(TitleOf(*ring));
  EXPECT_THAT(titles, ElementsAre("start: free", "1, 4: vertex 2 on face 0",
                                  "2–3: vertex 1 on face 0, vertex 2 on face 0"));
  // A ring is drawn at the dot of its state.
  std::set<std::pair<std::string, std::string>> dots;
  for (const Markup* dot : OfClass(picture, "state"))
    dots.insert({dot->attributes.at("cx"), dot->attributes.at("cy")});
  for (const Markup* ring : OfClass(picture, "planned"))
    EXPECT_TRUE(dots.contains({ring->attributes.at("cx"), ring->attributes.at("cy")}));
}

// The contacts of each state of the plan are written out. The key explains each kind of dot and
// line.
TEST(ContactGraphPicture, TellsContactsAndWhatIsDrawn) {
  const Markup picture =
      Drawn(Through({{OnFace(2)}, {OnFace(1), OnFace(2)}, {OnFace(1), OnFace(2)}, {OnFace(2)}}));
  std::vector<std::string> contacts;
  for (const Markup* text : OfClass(picture, "contacts-of")) contacts.push_back(text->text);
  std::vector<std::string> titles;
  for (const Markup* ring : OfClass(picture, "planned")) titles.push_back(TitleOf(*ring));
  EXPECT_EQ(contacts, titles);
  const double height = std::stod(picture.attributes.at("height"));
  const double width = std::stod(picture.attributes.at("width"));
  for (const char* kind : {"contacts-of", "key"}) {
    for (const Markup* text : OfClass(picture, kind)) {
      EXPECT_LT(std::stod(text->attributes.at("y")), height);
      EXPECT_LT(std::stod(text->attributes.at("x")) + 7 * static_cast<double>(text->text.size()),
                width);
    }
  }
  for (const char* kind : {"state", "initial", "goal", "planned", "neighbour", "way"}) {
    EXPECT_FALSE(OfClass(picture, kind).empty()) << kind;
    EXPECT_EQ(OfClass(picture, std::string(kind) + " key").size(), 1) << kind;
  }
  EXPECT_EQ(OfClass(picture, "key").size(), 6);
}

// At a later critical point, the way begins where the previous motion has ended.
TEST(ContactGraphPicture, HasOnlyTheMotionsThatAreAsked) {
  const Markup picture = Drawn(Through({{OnFace(2)}, {OnFace(1), OnFace(2)}, {OnFace(1)}}), {1, 2});
  std::vector<std::string> numbers;
  for (const Markup* text : OfClass(picture, "numbers")) numbers.push_back(text->text);
  EXPECT_THAT(numbers, ElementsAre("1", "2"));
  EXPECT_TRUE(OfClass(Drawn(Through({{OnFace(2)}}), {1, 1}), "planned").empty());
}

TEST(ContactGraphPicture, MarksWhereWaysBeginAndEnd) {
  const Markup picture = Drawn({});
  ASSERT_EQ(OfClass(picture, "initial").size(), 1u);
  EXPECT_EQ(TitleOf(*OfClass(picture, "initial")[0]), "free; 2 to a goal");
  ASSERT_EQ(OfClass(picture, "goal").size(), 1u);
  EXPECT_EQ(TitleOf(*OfClass(picture, "goal")[0]),
            "vertex 1 on face 0, vertex 2 on face 0; 0 to a goal");
}

TEST(ContactGraphPicture, StatesThatItHasNotStandBesideIt) {
  const Markup picture = Drawn(Through({{OnFace(7)}}));
  double farthest = 0;
  for (const Markup* dot : OfClass(picture, "state"))
    farthest = std::max(farthest, std::stod(dot->attributes.at("cx")));
  const Markup& ring = *OfClass(picture, "planned").at(1);
  const double x = std::stod(ring.attributes.at("cx"));
  EXPECT_GT(x, farthest);
  EXPECT_LT(x, std::stod(picture.attributes.at("width")));
  EXPECT_EQ(TitleOf(ring), "1: vertex 7 on face 0");
}

TEST(MatingPage, IsWellFormedAndHasAllOfIt) {
  MatingSubject subject{.title = "peg <1> into block",
                        .summary = "2 motions & more",
                        .graphs = {},
                        .motions = {{"vertex 1 on face 0", "vertex 1 on face 0", "none"},
                                    {"its way", "", "loss of vertex 1 on face 0"}},
                        .pictures = {{"1: vertex 1 on face 0", "not really a PNG"}}};
  for (int point = 0; point < 2; ++point)
    subject.graphs.push_back(ContactGraphPicture(TwoContacts(), Through({{OnFace(1)}}), {0, 1}));
  const Markup page = ReadMarkup(MatingPage(subject));
  EXPECT_EQ(page.All("h1").at(0)->text, "peg <1> into block");
  EXPECT_EQ(page.All("svg").size(), 2u);
  EXPECT_EQ(page.All("tr").size(), 3u);  // the header and two motions
  ASSERT_EQ(page.All("img").size(), 1u);
  EXPECT_THAT(page.All("img")[0]->attributes.at("src"), HasSubstr("data:image/png;base64,"));
  EXPECT_EQ(page.All("img")[0]->attributes.at("alt"), "1: vertex 1 on face 0");
  EXPECT_TRUE(page.All("script").empty());
}

TEST(MatingPage, TellsWhatTrialsSayOfTheMargins) {
  MatingSubject subject{.title = "peg into block",
                        .summary = "no motions",
                        .trials = MatingSubject::Trials{
                            "9 of 12 seated",
                            "rank correlation 0.4",
                            {{"1", "vertex 8 on face 6", "1.5", "2 of 12"},
                             {"7", "loss of edge 2 on edge 3", "more than 4", "1 of 9"}}}};
  const Markup page = ReadMarkup(MatingPage(subject));
  ASSERT_EQ(page.All("h2").size(), 2u);
  EXPECT_EQ(page.All("h2")[1]->text, "Trials in physics");
  ASSERT_EQ(page.All("td").size(), 6u);
  EXPECT_EQ(page.All("td")[2]->text, "2 of 12");
  subject.trials.reset();
  EXPECT_EQ(ReadMarkup(MatingPage(subject)).All("h2").size(), 1u);
}

}  // namespace
}  // namespace assay::report::contact_graph_picture_test
