#include "sim/report/numbers/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/sweep/database/wilson.h"

namespace assay::report {
namespace {

using domain::Dimension;

constexpr const char* kMinus = "−";
constexpr const char* kNothing = "–";

// Converts "1234567.89" to "1,234,567.89".
std::string Grouped(const std::string& digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  std::string grouped;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && i < point && (point - i) % 3 == 0) grouped += ',';
    grouped += digits[i];
  }
  return grouped;
}

std::string Superscript(int exponent) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += kDigits[c - '0'];
  return text;
}

std::string Scientific(double magnitude, int digits) {
  const std::string text = fmt::format("{:.{}e}", magnitude, digits - 1);
  const std::size_t e = text.find('e');
  return fmt::format("{} × 10{}", text.substr(0, e), Superscript(std::stoi(text.substr(e + 1))));
}

// Removes zeros at the end of a fraction: "0.50" becomes "0.5".
std::string Trimmed(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.resize(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string Magnitude(double value, int digits) {
  constexpr double kLeastFixed = 1e-4;
  if (value == 0) return "0";
  if (value < kLeastFixed) return Scientific(value, std::min(digits, 2));
  if (value >= 1e9) return Scientific(value, digits);
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(value))));
  return Grouped(Trimmed(fmt::format("{:.{}f}", value, decimals)));
}

std::string WithUnit(const std::string& number, Dimension dimension) {
  if (dimension == Dimension::kAngle) return number + "°";
  return domain::Beside(number, domain::ShownUnitOf(dimension));
}

// Returns a percentage with one digit after the point, or with as many digits as it needs to differ
// from 0 and 100.
std::string Percentage(double rate) {
  for (int decimals = 1; decimals < 6; ++decimals) {
    const std::string text = fmt::format("{:.{}f}", 100 * rate, decimals);
    const double read = std::stod(text);
    if ((read > 0 || rate <= 0) && (read < 100 || rate >= 1)) return Trimmed(text);
  }
  return rate < 0.5 ? "0" : "100";
}

}  // namespace

std::string CountText(std::int64_t count) {
  const std::string digits = Grouped(std::to_string(std::abs(count)));
  return count < 0 ? kMinus + digits : digits;
}

std::string CountText(std::int64_t count, std::string_view what) {
  return fmt::format("{} {}{}", CountText(count), what, count == 1 ? "" : "s");
}

std::string NumberText(double value, int digits) {
  if (std::isnan(value)) return kNothing;
  const std::string text = std::isinf(value) ? "∞" : Magnitude(std::abs(value), digits);
  return value < 0 ? kMinus + text : text;
}

double Shown(double value, Dimension dimension) {
  return value / domain::ShownUnitOf(dimension).factor;
}

std::string QuantityText(double value, Dimension dimension) {
  if (std::isnan(value)) return kNothing;
  return WithUnit(NumberText(Shown(value, dimension)), dimension);
}

std::string IntervalText(const Interval& interval, Dimension dimension) {
  const auto [low, high] = interval;
  if (std::isnan(low) || std::isnan(high)) return kNothing;
  if (std::isinf(low) && std::isinf(high)) return "anything";
  if (std::isinf(high)) return "≥ " + QuantityText(low, dimension);
  if (std::isinf(low)) return "≤ " + QuantityText(high, dimension);
  const std::string low_text = NumberText(Shown(low, dimension));
  const std::string high_text = NumberText(Shown(high, dimension));
  if (low_text == high_text) return WithUnit(low_text, dimension);
  if (low_text == kMinus + high_text) return WithUnit("±" + high_text, dimension);
  return fmt::format("{} to {}", low_text, WithUnit(high_text, dimension));
}

std::string RateText(int successes, int trials) {
  if (trials == 0) return kNothing;
  return Percentage(static_cast<double>(successes) / trials) + " %";
}

std::string WilsonText(int successes, int trials) {
  if (trials == 0) return kNothing;
  const Interval interval = sweep::WilsonInterval(successes, trials);
  return fmt::format("{} to {} %", Percentage(interval.low), Percentage(interval.high));
}

std::string DurationText(double seconds) {
  if (seconds < 90) return NumberText(seconds, 2) + " s";
  if (seconds < 5400) return NumberText(seconds / 60, 2) + " min";
  return NumberText(seconds / 3600, 2) + " h";
}

}  // namespace assay::report
