#pragma once

#include <array>
#include <string_view>

#include "sim/render/palette.h"

namespace assay::report {

// The colour language: one meaning each, the same on every page and picture.
// Told apart by people with any kind of colour vision (tested on a model of
// it), and never the only sign: verdicts have marks and words as well,
// predicted and observed have shapes.
struct Colour {
  std::string_view name;
  std::string_view light;  // "#rrggbb", on a light ground
  std::string_view dark;   // on a dark one
};

inline constexpr Colour kContained{"contained", "#0a9a78", "#5be3bd"};
inline constexpr Colour kWithinResolution{"within-resolution", "#748ca4", "#acc4ec"};
inline constexpr Colour kInconclusive{"inconclusive", "#c98500", "#ffd35c"};
inline constexpr Colour kViolated{"violated", render::kViolated.hex, "#ff7a59"};
inline constexpr Colour kNotClaimed{"not-claimed", "#4f5560", "#7d838e"};
inline constexpr Colour kPredicted{"predicted", render::kPredicted.hex, "#3f83bd"};
inline constexpr Colour kObserved{"observed", render::kObserved.hex, "#f1f4f8"};

inline constexpr std::array kPalette = {kContained,  kWithinResolution, kInconclusive, kViolated,
                                        kNotClaimed, kPredicted,        kObserved};

inline constexpr std::string_view kLightGround = "#ffffff";
inline constexpr std::string_view kDarkGround = "#12171e";

}  // namespace assay::report
