#include "sim/report/fine_motion/contact_graph_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>

namespace assay::report {
namespace {

using check::ContactSet;
using finemotion::ContactKey;

// Lengths in pixels.
constexpr double kLeft = 48;  // width of the labels of the dimensions
constexpr double kTop = 34;
constexpr double kRow = 92;
constexpr double kGraphWidth = 620;  // least width of the graph
constexpr double kSpacing = 8;       // least distance between states of the graph
constexpr double kColumn = 74;       // width of the column of a state outside the graph
constexpr double kNumberUp = 10;     // height of numbers above their states
constexpr double kLetter = 8;        // greatest width of a letter
constexpr double kLine = 20;         // height of a line of the key

// The picture has its own style rules, because a picture file has no page around it. Their class
// limits them to the picture if it is in a page.
constexpr const char* kGraphRules =
    ".contacts text { font: 14px system-ui, sans-serif; fill: #33404f; } "
    ".contacts .ground { fill: #ffffff; } "
    ".contacts .neighbour { fill: none; stroke: #98a2ad; stroke-width: .5; stroke-opacity: .55; } "
    ".contacts .state { fill: #4f5560; } "
    ".contacts .initial { fill: #1d4ed8; } "
    ".contacts .goal { fill: #15803d; } "
    ".contacts .way { fill: none; stroke: #c2410c; stroke-width: 1.8; } "
    ".contacts .planned { fill: #ffffff; stroke: #c2410c; stroke-width: 2.2; } "
    ".contacts text.numbers { fill: #9a3412; font-weight: 600; paint-order: stroke; "
    "stroke: #ffffff; stroke-width: 3px; }";

struct Place {
  double x = 0;
  double y = 0;
};

double RowHeight(int dimension) { return kTop + kRow * (finemotion::kPoseDimensions - dimension); }

std::string TextOf(const ContactSet& contacts) {
  std::vector<std::string> names;
  for (const ContactKey& contact : contacts) names.push_back(finemotion::Name(contact));
  return names.empty() ? "free" : fmt::format("{}", fmt::join(names, ", "));
}

// The places of the states of a graph. The states of a row are ordered by the middle of their
// parents, so that few lines cross.
class Layout {
 public:
  explicit Layout(const finemotion::ContactGraph& graph) : places_(graph.states.size()) {
    std::map<int, std::vector<std::size_t>, std::greater<>> rows;  // by dimension
    for (std::size_t i = 0; i < graph.states.size(); ++i)
      rows[graph.states[i].dimension].push_back(i);
    for (const auto& [dimension, states] : rows)
      width_ = std::max(width_, kSpacing * static_cast<double>(states.size()));
    for (auto& [dimension, states] : rows) {
      std::ranges::stable_sort(states, {},
                               [&](std::size_t i) { return MiddleOfParents(graph.states[i]); });
      const double apart = width_ / static_cast<double>(states.size());
      for (std::size_t k = 0; k < states.size(); ++k) {
        places_[states[k]] = {kLeft + apart * (static_cast<double>(k) + 0.5), RowHeight(dimension)};
      }
      least_dimension_ = dimension;
    }
  }

  const Place& PlaceOf(std::size_t state) const { return places_[state]; }
  double width() const { return width_; }
  int least_dimension() const { return least_dimension_; }

 private:
  double MiddleOfParents(const finemotion::ContactState& state) const {
    if (state.parents.empty()) return 0;
    double sum = 0;
    for (const int parent : state.parents) sum += places_[static_cast<std::size_t>(parent)].x;
    return sum / static_cast<double>(state.parents.size());
  }

  std::vector<Place> places_;
  double width_ = kGraphWidth;
  int least_dimension_ = finemotion::kPoseDimensions;
};

// A kind of dot or line, and its meaning.
struct Kind {
  const char* name;  // class in the style rules
  double radius;     // radius of a dot; 0 for a line
  const char* meaning;
};
constexpr std::array kKinds = {
    Kind{"state", 2.5, "a contact state, in the row of its dimension"},
    Kind{"initial", 4, "a state in which the way begins"},
    Kind{"goal", 4, "a goal"},
    Kind{"planned", 5, "a state in which motions of the plan end, with their numbers"},
    Kind{"neighbour", 0, "one contact is made or broken"},
    Kind{"way", 0, "the way of the plan"},
};

// A state that the plan reaches.
struct Stop {
  ContactSet contacts;
  std::vector<int> motions = {};  // the motions that end in it, from 1; 0 for the start
  Place place = {};
};

// Returns the numbers of a stop's motions: "start, 3-5, 8".
std::string NumbersOf(const Stop& stop) {
  std::vector<std::string> numbers;
  const std::vector<int>& motions = stop.motions;
  for (std::size_t i = 0; i < motions.size();) {
    std::size_t last = i;
    while (last + 1 < motions.size() && motions[last + 1] == motions[last] + 1) ++last;
    if (motions[i] == 0) {
      numbers.emplace_back("start");
      last = i;
    } else if (last > i) {
      numbers.push_back(fmt::format("{}–{}", motions[i], motions[last]));
    } else {
      numbers.push_back(fmt::format("{}", motions[i]));
    }
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(numbers, ", "));
}

class Picture {
 public:
  Picture(const finemotion::LocalTopology& topology, const check::PlannedContacts& planned,
          const MotionRange& motions)
      : topology_(topology), layout_(topology.graph), least_(layout_.least_dimension()) {
    if (motions.begin == motions.end) return;
    Visit(planned.motions[motions.begin].before, static_cast<int>(motions.begin));
    for (std::size_t i = motions.begin; i < motions.end; ++i)
      Visit(planned.motions[i].after, static_cast<int>(i) + 1);
  }

  Element Draw() const {
    const double width = std::max(kLeft + layout_.width() + kColumn * columns_, TextWidth());
    const double graph_height = RowHeight(least_) + kTop;
    const double height = graph_height + kLine * static_cast<double>(KeyLines());
    Element svg("svg");
    svg.Set("xmlns", "http://www.w3.org/2000/svg")
        .Set("class", "contacts")
        .Set("viewBox", fmt::format("0 0 {:.0f} {:.0f}", width, height))
        .Set("width", width)
        .Set("height", height)
        .Set("role", "img")
        .Set("aria-label", "Contact states and the way of the plan through them");
    svg.Add("style", kGraphRules);
    svg.Add("rect").Set("class", "ground").Set("width", width).Set("height", height);
    for (int dimension = finemotion::kPoseDimensions; dimension >= least_; --dimension) {
      svg.Add("text", fmt::format("{}-D", dimension))
          .Set("x", 8)
          .Set("y", RowHeight(dimension) + 4);
    }
    svg.Add("path").Set("class", "neighbour").Set("d", Neighbours());
    svg.Add("path").Set("class", "way").Set("d", Way());
    AddStates(svg);
    AddStops(svg);
    AddKey(svg, graph_height);
    AddContactsOfStops(svg, graph_height + kLine * kKinds.size());
    return svg;
  }

 private:
  ContactSet ContactsOf(const finemotion::ContactState& state) const {
    ContactSet contacts;
    for (const int contact : state.contacts) {
      contacts.push_back(
          finemotion::KeyOf(topology_.space.contacts[static_cast<std::size_t>(contact)]));
    }
    std::ranges::sort(contacts);
    return contacts;
  }

  void Visit(const ContactSet& contacts, int motion) {
    auto stop = std::ranges::find(stops_, contacts, &Stop::contacts);
    if (stop == stops_.end()) {
      stop = stops_.insert(stop, Stop{.contacts = contacts, .place = PlaceFor(contacts)});
    }
    stop->motions.push_back(motion);
    way_.push_back(stop->place);
  }

  Place PlaceFor(const ContactSet& contacts) {
    for (std::size_t i = 0; i < topology_.graph.states.size(); ++i) {
      if (ContactsOf(topology_.graph.states[i]) == contacts) return layout_.PlaceOf(i);
    }
    const int dimension =
        std::max(0, finemotion::kPoseDimensions - static_cast<int>(contacts.size()));
    least_ = std::min(least_, dimension);
    return {kLeft + layout_.width() + kColumn * (columns_++ + 0.5), RowHeight(dimension)};
  }

  std::string Neighbours() const {
    std::string lines;
    const auto& states = topology_.graph.states;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const Place from = layout_.PlaceOf(i);
      for (const int son : states[i].sons) {
        const Place to = layout_.PlaceOf(static_cast<std::size_t>(son));
        lines += fmt::format("M{:.0f} {:.0f}L{:.0f} {:.0f}", from.x, from.y, to.x, to.y);
      }
    }
    return lines;
  }

  std::string Way() const {
    std::string line;
    for (const Place& place : way_)
      line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", place.x, place.y);
    return line;
  }

  void AddStates(Element& svg) const {
    for (std::size_t i = 0; i < topology_.graph.states.size(); ++i) {
      const Place place = layout_.PlaceOf(i);
      Element& dot = svg.Add("circle").Set("class", "state");
      dot.Set("cx", place.x).Set("cy", place.y).Set("r", 2.5);
      dot.Add("title", TitleOf(i));
    }
    AddMarks(svg, topology_.initial, "initial");
    AddMarks(svg, topology_.goals, "goal");
  }

  std::string TitleOf(std::size_t state) const {
    const int to_goal = topology_.graph.states[state].to_goal;
    return TextOf(ContactsOf(topology_.graph.states[state])) +
           (to_goal < 0 ? "" : fmt::format("; {} to a goal", to_goal));
  }

  void AddMarks(Element& svg, const std::vector<int>& states, const char* kind) const {
    for (const int state : states) {
      const Place place = layout_.PlaceOf(static_cast<std::size_t>(state));
      Element& mark = svg.Add("circle").Set("class", kind);
      mark.Set("cx", place.x).Set("cy", place.y).Set("r", 4);
      mark.Add("title", TitleOf(static_cast<std::size_t>(state)));
    }
  }

  void AddStops(Element& svg) const {
    for (const Stop& stop : stops_) {
      const std::string numbers = NumbersOf(stop);
      Element& ring = svg.Add("circle").Set("class", "planned");
      ring.Set("cx", stop.place.x).Set("cy", stop.place.y).Set("r", 5);
      ring.Add("title", KeyOf(stop));
      svg.Add("text", numbers)
          .Set("class", "numbers")
          .Set("text-anchor", "middle")
          .Set("x", stop.place.x)
          .Set("y", stop.place.y - kNumberUp);
    }
  }

  // Returns the width that the longest text below the graph needs.
  double TextWidth() const {
    std::size_t letters = 0;
    for (const Kind& kind : kKinds) letters = std::max(letters, std::string(kind.meaning).size());
    for (const Stop& stop : stops_) letters = std::max(letters, KeyOf(stop).size());
    return kLeft + kLetter * static_cast<double>(letters);
  }
  static std::string KeyOf(const Stop& stop) {
    return fmt::format("{}: {}", NumbersOf(stop), TextOf(stop.contacts));
  }
  std::size_t KeyLines() const { return kKinds.size() + stops_.size(); }

  // Adds the legend, which explains dots and lines.
  static void AddKey(Element& svg, double top) {
    double y = top;
    for (const Kind& kind : kKinds) {
      const double middle = y - 5;
      if (kind.radius > 0) {
        svg.Add("circle")
            .Set("class", fmt::format("{} key", kind.name))
            .Set("cx", kLeft / 2)
            .Set("cy", middle)
            .Set("r", kind.radius);
      } else {
        svg.Add("path")
            .Set("class", fmt::format("{} key", kind.name))
            .Set("d", fmt::format("M8 {0}L{1} {0}", middle, kLeft - 8));
      }
      svg.Add("text", kind.meaning).Set("class", "key").Set("x", kLeft).Set("y", y);
      y += kLine;
    }
  }

  // Adds the contacts of each stop, with the numbers of the motions that end there.
  void AddContactsOfStops(Element& svg, double top) const {
    double y = top;
    for (const Stop& stop : stops_) {
      svg.Add("text", KeyOf(stop)).Set("class", "contacts-of").Set("x", kLeft).Set("y", y);
      y += kLine;
    }
  }

  const finemotion::LocalTopology& topology_;
  Layout layout_;
  int least_;  // the least dimension of a row
  int columns_ = 0;
  std::vector<Stop> stops_;
  std::vector<Place> way_;
};

}  // namespace

Element ContactGraphPicture(const finemotion::LocalTopology& topology,
                            const check::PlannedContacts& planned, const MotionRange& motions) {
  return Picture(topology, planned, motions).Draw();
}

}  // namespace assay::report
