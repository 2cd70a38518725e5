#include "planner/domain/workcell/sensor_promise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/base/input_files/document.h"

namespace assay::domain {
namespace {

constexpr std::string_view kNote = "# calibrated: ";

// Returns the number rounded up to two digits, without an exponent.
std::string RoundedUp(double value) {
  if (value == 0) return "0";
  const int digits = 1 - static_cast<int>(std::floor(std::log10(value)));
  const double unit = std::pow(10, -digits);
  // Numbers that have two digits already, apart from rounding, stay as they are.
  return fmt::format("{:.{}f}", std::ceil(value / unit - 1e-9) * unit, std::max(digits, 0));
}

std::size_t OffsetOf(const std::string& text, const FilePlace& place) {
  std::size_t line = 0;
  for (int i = 1; i < place.line; ++i) line = text.find('\n', line) + 1;
  return line + static_cast<std::size_t>(place.column - 1);
}

// Returns the text from its first character that is no space.
std::string_view Trimmed(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(" \t\r"), text.size()));
}

// `rest` is the text between the YAML map of a promise and the end of its line. Returns this text
// with the note as a comment, which replaces an earlier note and keeps other comments. If `rest`
// has anything but a comment, it is returned as it is, because a comment before it would hide it.
std::string Noted(std::string_view rest, const std::string& note) {
  std::string_view other = Trimmed(rest);
  if (!other.empty() && other.front() != '#') return std::string(rest);
  if (other.starts_with(kNote)) other = other.substr(std::min(other.find('#', 1), other.size()));
  return fmt::format("  {}{}{}{}", kNote, note, other.empty() ? "" : "  ", other);
}

}  // namespace

std::string PromiseText(const SensorPromise& promise, const Units& units) {
  return fmt::format(
      "{{x: {}, y: {}, z: {}, theta: {}}}", RoundedUp(promise.x / units.length.factor),
      RoundedUp(promise.y / units.length.factor), RoundedUp(promise.z / units.length.factor),
      RoundedUp(promise.theta / units.angle.factor));
}

std::string WithPromise(const std::string& text, const std::string& file, const std::string& sensor,
                        const SensorPromise& promise, const std::string& note) {
  const Document document = Document::Parse(text, file);
  document.RequireFormat("assay-workcell/1");
  const Value error = document.root().At("sensors").At(sensor).At("error");
  const std::size_t start = OffsetOf(text, error.Place());
  const std::size_t end_of_line = std::min(text.find('\n', start), text.size());
  const std::string_view line = std::string_view(text).substr(start, end_of_line - start);
  const std::size_t size = line.find('}') + 1;
  if (!line.starts_with('{') || size == 0 || line.find('#') < size) {
    error.Fail("the promise is not written on one line", "{x: ..., y: ..., z: ..., theta: ...}");
  }
  return text.substr(0, start) + PromiseText(promise, ReadUnits(document.root())) +
         Noted(line.substr(size), note) + text.substr(end_of_line);
}

}  // namespace assay::domain
