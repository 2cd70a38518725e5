#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/interval.h"
#include "planner/domain/matings/mating.h"
#include "planner/plan/certificates/condition.h"
#include "planner/plan/certificates/error_kind.h"

namespace assay::plan {

using StepId = Id<struct StepTag>;  // index in Plan::steps, which are in the order of insertion

// A bounded variable of a certificate, such as "dx_block", in [low, high], metres or radians.
struct ErrorVariable {
  std::string name;
  Interval range;
  domain::Dimension dimension = domain::Dimension::kLength;  // of its kind (error_kind.h)

  bool operator==(const ErrorVariable&) const = default;
};

struct ErrorValue {
  std::string name;  // name of a variable
  double value = 0;

  bool operator==(const ErrorValue&) const = default;
};

// A box that contains every possible true pose of a part, relative to its believed pose. For a part
// that rests, it bounds the origin in the world's axes (x, y, z), and the turn about the world's z
// through it (theta). For a part that is held, it is in the frame of the commanded tool: it bounds
// the grasped point, and the turn about the tool's z by theta, then by tip about x and by twist
// about y.
//
// The hand errs anew at each commanded pose. So a part in the hand has different error sets at the
// end of one step and at the beginning of the next.
struct ErrorSet {
  domain::PartId part;
  bool in_hand = false;
  Interval x, y, z, theta;  // metres, radians
  Interval tip = {};        // only in the hand; radians
  Interval twist = {};      // only in the hand, left by closed pads; radians

  bool operator==(const ErrorSet&) const = default;
};

// One number of an error set.
struct ErrorComponent {
  std::string_view name;  // in files and in output
  domain::Dimension dimension;
  Interval ErrorSet::*range;
  bool only_in_hand = false;
};
// Returns the components of a certificate's error sets, in the order of plan files and output.
std::span<const ErrorComponent> ErrorComponents();

enum class Relation { kLess, kGreater };

// A certificate gives the ratio of a load to the bearable load. This value stands for an infinite
// ratio, if nothing bears the load.
inline constexpr double kNothingBorne = 1e6;

// An uncertainty-reduction precondition, expression < limit (or >), with the result of its proof.
struct CertifiedPrecondition {
  Condition condition;
  std::string meaning = {};     // text for people: "contact 2 lies on the inner side of finger 1"
  std::string expression = {};  // over the certificate's variables and its shared expressions
  Relation relation = Relation::kLess;
  double limit = 0;
  double bound = 0;         // SUP of the expression for <, INF for >; guaranteed, rounded outward
  double margin = 0;        // distance from the bound to the limit; positive: it is proved
  double gap = 0;           // greatest difference of the bound from the true value
  std::string method = {};  // name of the bounding method that gave the bound
  std::vector<ErrorValue> worst = {};  // worst corner found, of the expression's variables
  Circumstance circumstance = Circumstance::kUsual;

  bool holds() const { return margin > 0; }
  // Returns true if the precondition is about the ratio of a load to the bearable load, and if it
  // is not proved that something bears the load for all errors.
  bool IsUnborne() const {
    return condition->dimension == domain::Dimension::kRatio && bound >= kNothingBorne;
  }
  bool operator==(const CertifiedPrecondition&) const = default;
};

// A kind of precondition (condition_table.h) that steps with this action usually need, but that
// does not apply to this step.
struct NotNeeded {
  Condition condition;
  std::string reason;  // text for people and programs: a reason that the kind allows

  bool operator==(const NotNeeded&) const = default;
};

// A remedy for preconditions that could not be proved at first.
struct Resolution {
  std::string resolver;            // "sensing", "squeezing", "moving", "verification"
  std::vector<StepId> steps = {};  // steps inserted for this step, in order of execution
  std::string why;                 // the precondition that failed, with its bound

  bool operator==(const Resolution&) const = default;
};

// The knowledge before and after a step, and the claims that were proved about the step. A
// certificate is empty if the plan was made without regard to uncertainty.
struct Certificate {
  // Input error sets: all variables of the preconditions.
  std::vector<ErrorVariable> variables = {};
  // Expressions that the preconditions share, each once. planner/algebra/expression/parse.h reads
  // them.
  std::vector<std::string> shared = {};
  std::vector<ErrorSet> before = {};  // input error sets of the parts that the step handles
  std::vector<CertifiedPrecondition> preconditions = {};
  // The kinds of precondition that the step usually needs and that do not apply here, with reasons.
  // Every kind of the step is either here or among the preconditions.
  std::vector<NotNeeded> not_needed = {};
  std::vector<ErrorSet> after = {};  // output error sets of the same parts
  std::vector<Resolution> resolutions = {};

  bool operator==(const Certificate&) const = default;
};

// Returns what a certificate says of a guarded move: the greatest distance, in metres, between the
// expected and the actual contact. The preconditions kLandingHeight and kSeat say that this
// distance is at most the workcell's guarded travel. If nothing is certified, the whole guarded
// travel is returned.
double DoubtOfContact(const Certificate& certificate, double guarded_travel);

}  // namespace assay::plan
