#pragma once

#include <array>
#include <string_view>

#include "sim/render/palette.h"

namespace assay::report {

// A colour with one meaning, which is the same on every page and picture. People with any kind of
// colour vision can distinguish the colours (tested on a model of colour vision). Colour is never
// the only sign: verdicts have marks and words, too, and predicted and observed values have shapes.
struct Colour {
  std::string_view name;
  std::string_view light;  // "#rrggbb", for a light background
  std::string_view dark;   // "#rrggbb", for a dark background
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
