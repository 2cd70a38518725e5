#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/interval.h"
#include "planner/domain/mating/mating.h"

namespace assay::plan {

using StepId = Id<struct StepTag>;  // index in Plan::steps, which is the order of insertion

// A bounded variable that a certificate speaks of: "dx_block", in [low, high], metres or radians.
struct ErrorVariable {
  std::string name;
  Interval range;

  bool operator==(const ErrorVariable&) const = default;
};

struct ErrorValue {
  std::string name;  // of a variable
  double value = 0;

  bool operator==(const ErrorValue&) const = default;
};

// Where the true pose of a part may be, relative to where it is believed to be: a box that contains
// every error. While it rests: of its origin in the world's axes (x, y, z), and about the world's z
// through it (theta). While it is held: in the frame of the commanded tool, of the grasped point,
// and turned about the tool's z by theta, then by tip about x and by twist about y. The hand errs
// anew at each pose that it is told: a part in the hand is known to within other sets at the end of
// one step and at the beginning of the next.
struct ErrorSet {
  domain::PartId part;
  bool in_hand = false;
  Interval x, y, z, theta;  // metres, radians
  Interval tip = {};        // in the hand; radians
  Interval twist = {};      // in the hand: what closed pads leave; radians

  bool operator==(const ErrorSet&) const = default;
};

enum class Relation { kLess, kGreater };

// expression < limit (or >), and what was proved of it: an uncertainty-reduction precondition.
struct CertifiedPrecondition {
  std::string condition;   // which: "between fingers", "pad contact", "landing height", "slide-in"
  std::string meaning;     // for people: "contact 2 lies on the inner side of finger 1"
  std::string expression;  // over the certificate's variables and what it shares with others
  Relation relation = Relation::kLess;
  double limit = 0;
  double bound = 0;   // SUP of the expression for <, INF for >; guaranteed, rounded outward
  double margin = 0;  // from the bound to the limit; positive: proved
  double gap = 0;     // how loose the bound may be
  std::string rung;   // the method that gave it
  std::vector<ErrorValue> worst = {};  // the worst corner found, of the expression's variables

  bool holds() const { return margin > 0; }
  bool operator==(const CertifiedPrecondition&) const = default;
};

// A kind of precondition (condition_kind.h) that such steps need and this one has none of.
struct NotNeeded {
  std::string condition;
  std::string reason;  // for people and programs: one that the kind allows

  bool operator==(const NotNeeded&) const = default;
};

// What was done about preconditions that could not be proved at first.
struct Resolution {
  std::string resolver;            // "sensing", "squeezing", "moving", "verification"
  std::vector<StepId> steps = {};  // that were inserted for this step, in order of execution
  std::string why;                 // the precondition that failed, with its bound

  bool operator==(const Resolution&) const = default;
};

// What is known before and after a step, and what was proved of it. Empty: the plan was made
// without regard to uncertainty.
struct Certificate {
  std::vector<ErrorVariable> variables = {};  // input error sets: all that the preconditions name
  // What expressions have in common, each once: planner/algebra/expression/text.h reads them.
  std::vector<std::string> shared = {};
  std::vector<ErrorSet> before = {};  // of the parts that the step is about
  std::vector<CertifiedPrecondition> preconditions = {};
  // With the preconditions: all kinds that the step needs.
  std::vector<NotNeeded> not_needed = {};
  std::vector<ErrorSet> after = {};  // output error sets of the same parts
  std::vector<Resolution> resolutions = {};

  bool operator==(const Certificate&) const = default;
};

// How far from where it is expected a guarded move may meet something, metres: its preconditions
// "landing height" and "seat" are that this stays within the workcell's guarded travel. All of the
// travel, if nothing is certified.
double DoubtOfContact(const Certificate& certificate, double guarded_travel);

}  // namespace assay::plan
