#include "planner/verify/certificate_algebra.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "planner/algebra/expression/parse.h"
#include "planner/algebra/expression/text.h"
#include "planner/base/input_files/input_error.h"

namespace assay::verify {
namespace {

bool IsName(const std::string& text) {
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
  return !text.empty() && is_letter(static_cast<unsigned char>(text[0])) &&
         std::ranges::all_of(text,
                             [&](unsigned char c) { return is_letter(c) || std::isdigit(c) != 0; });
}

bool HoldsNumber(const Interval& range) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return range.low < kInfinity && range.high > -kInfinity;
}

}  // namespace

CertificateAlgebra::CertificateAlgebra(const plan::PlannedStep& step, const std::string& file)
    : place_(fmt::format("{}: certificate of {}", file, step.name)),
      pool_(std::make_unique<algebra::ExpressionPool>()) {
  for (const auto& [name, range, dimension] : step.certificate.variables) {
    if (!IsName(name) || pool_->Find(name)) {
      throw InputError({.file = place_}, fmt::format("'{}' is no new variable", name),
                       "names of letters, digits and _, each once");
    }
    if (!HoldsNumber(range)) {
      throw InputError({.file = place_}, fmt::format("the range of '{}' holds no number", name),
                       "[low, high] with a number between them");
    }
    pool_->Declare(name, range);
    dimensions_.push_back(dimension);
  }
  box_ = algebra::DeclaredBox(*pool_);
  shared_ = algebra::ParseShared(step.certificate.shared, *pool_, {place_, 1, 1});
}

algebra::Expression CertificateAlgebra::Read(const std::string& text) const {
  return algebra::Parse(text, *pool_, {place_, 1, 1}, algebra::Layout::kAsInFile, shared_);
}

}  // namespace assay::verify
