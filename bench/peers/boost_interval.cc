#include "bench/peers/boost_interval.h"

#include <boost/numeric/interval.hpp>
#include <unordered_map>
#include <vector>

#include "planner/algebra/expression/nodes.h"
#include "planner/base/check.h"

namespace assay::peers {
namespace {

using algebra::Expression;
using algebra::Operator;
namespace numeric = boost::numeric;
namespace policies = boost::numeric::interval_lib;
template <class Rounding>
using IntervalRounding = numeric::interval<
    double, policies::policies<policies::save_state<Rounding>, policies::checking_base<double>>>;
using ByDefault = IntervalRounding<policies::rounded_transc_std<double>>;
using Opposite =
    IntervalRounding<policies::rounded_transc_opp<double, policies::rounded_arith_opp<double>>>;
using SetOnce = policies::unprotect<Opposite>::type;

struct NoGuard {
  NoGuard() {}
};

struct Step {
  Operator op = Operator::kConstant;
  int exponent = 0;
  std::vector<std::size_t> operands;
};

}  // namespace

class BoostInterval::Evaluation {
 public:
  virtual ~Evaluation() = default;
  virtual Interval Range() = 0;
};

// `Guard` sets the processor's rounding mode for these numbers while it exists.
template <class Number, class Guard>
class BoostInterval::EvaluationIn : public Evaluation {
 public:
  EvaluationIn(const Expression& e, std::span<const Expression> others,
               const algebra::ConstraintSet& box) {
    for (const Expression& other : others) Add(other, box);
    Add(e, box);
  }

  Interval Range() override {
    const Guard guard;
    for (std::size_t i = 0; i < steps_.size(); ++i) Carry(steps_[i], values_[i]);
    return {values_.back().lower(), values_.back().upper()};
  }

 private:
  // Adds the subexpressions that are not there yet, and the expression itself as the last.
  void Add(const Expression& e, const algebra::ConstraintSet& box) {
    for (const Expression& node : algebra::NodesOf(e)) {
      if (!node.IsConstant() && !places_.contains(node.index())) AddNode(node, box);
    }
    if (e.IsConstant()) AddConstant(e.constant());
  }

  void AddNode(const Expression& node, const algebra::ConstraintSet& box) {
    Step step = {.op = node.op(), .exponent = 0, .operands = {}};
    Number value = 0;
    if (node.op() == Operator::kPower) step.exponent = node.exponent();
    if (node.op() == Operator::kVariable) {
      const Interval& x = box.box[static_cast<std::size_t>(node.variable().index())];
      value = Number(x.low, x.high);
    }
    for (const Expression& operand : node.operands()) {
      step.operands.push_back(operand.IsConstant() ? AddConstant(operand.constant())
                                                   : places_.at(operand.index()));
    }
    places_[node.index()] = steps_.size();
    steps_.push_back(std::move(step));
    values_.push_back(value);
  }

  std::size_t AddConstant(double constant) {
    steps_.emplace_back();
    values_.emplace_back(constant);
    return steps_.size() - 1;
  }

  void Carry(const Step& step, Number& value) const {
    if (step.op == Operator::kConstant || step.op == Operator::kVariable) return;
    value = values_[step.operands[0]];
    if (step.op == Operator::kSum) {
      for (std::size_t i = 1; i < step.operands.size(); ++i) value += values_[step.operands[i]];
    } else if (step.op == Operator::kProduct) {
      for (std::size_t i = 1; i < step.operands.size(); ++i) value *= values_[step.operands[i]];
    } else if (step.op == Operator::kPower) {
      value = numeric::pow(value, step.exponent);
    } else if (step.op == Operator::kSin) {
      value = numeric::sin(value);
    } else {
      ASSAY_CHECK(step.op == Operator::kCos, "not an operation of chains of transforms");
      value = numeric::cos(value);
    }
  }

  std::vector<Step> steps_;
  std::vector<Number> values_;
  std::unordered_map<int, std::size_t> places_;  // places of expressions in values_, by index
};

BoostInterval::BoostInterval(const Expression& e, std::span<const Expression> others,
                             const algebra::ConstraintSet& box, Rounding rounding) {
  if (rounding == Rounding::kSetOnce) {
    evaluation_ =
        std::make_unique<EvaluationIn<SetOnce, Opposite::traits_type::rounding>>(e, others, box);
  } else {
    evaluation_ = std::make_unique<EvaluationIn<ByDefault, NoGuard>>(e, others, box);
  }
}
BoostInterval::~BoostInterval() = default;
BoostInterval::BoostInterval(BoostInterval&&) noexcept = default;

Interval BoostInterval::Range() { return evaluation_->Range(); }

}  // namespace assay::peers
