#pragma once

#include <span>
#include <string_view>

#include "planner/domain/units/units.h"

namespace assay::plan {

// A kind of bounded error. The names of its variables begin with the stem, such as "dx_block",
// "dx_hand" and "dx_hand_2". Kinds are compared by their addresses.
struct ErrorKind {
  std::string_view stem;
  domain::Dimension dimension;
  std::string_view meaning;  // for people
};

// The kinds of errors of parts and of the hand. Files planner/uncertainty/error_sets/*.h say how
// they arise.
namespace error {

// displacement of a part in the world's axes, or of the hand in its own axes
inline constexpr ErrorKind kX = {"dx", domain::Dimension::kLength, "displacement along x"};
inline constexpr ErrorKind kY = {"dy", domain::Dimension::kLength, "displacement along y"};
inline constexpr ErrorKind kZ = {"dz", domain::Dimension::kLength, "displacement along z"};
// turn about the world's z, or about the hand's z
inline constexpr ErrorKind kTheta = {"theta", domain::Dimension::kAngle, "turn about z"};
// how closing pads leave a part (squeezing.h): along the pads, up or down, and turned about their
// normal; across them, if the part's friction moves the hand; and, if the pads jam, across the
// pads, turned about the hand's z, and about its x
inline constexpr ErrorKind kSlip = {"slip", domain::Dimension::kLength,
                                    "shift along the closing pads"};
inline constexpr ErrorKind kRise = {"rise", domain::Dimension::kLength,
                                    "shift up or down the closing pads"};
inline constexpr ErrorKind kTwist = {"twist", domain::Dimension::kAngle,
                                     "turn about the direction in which the pads close"};
inline constexpr ErrorKind kGive = {"give", domain::Dimension::kLength,
                                    "shift as a part's friction moves the hand"};
inline constexpr ErrorKind kJam = {"jam", domain::Dimension::kLength, "shift across jammed pads"};
inline constexpr ErrorKind kSkew = {"skew", domain::Dimension::kAngle,
                                    "turn about the hand's z in jammed pads"};
inline constexpr ErrorKind kTip = {"tip", domain::Dimension::kAngle,
                                   "turn about the hand's x in jammed pads"};
// how opening pads leave a part (release.h): settled upright, led by a wrist that yields, and
// within the play of its seat
inline constexpr ErrorKind kSettle = {"settle", domain::Dimension::kLength,
                                      "shift as the hand lets the part go"};
inline constexpr ErrorKind kYield = {"yield", domain::Dimension::kLength,
                                     "shift as the wrist gives way"};
inline constexpr ErrorKind kPlay = {"play", domain::Dimension::kLength,
                                    "shift within the play of the seat"};
inline constexpr ErrorKind kTurn = {"turn", domain::Dimension::kAngle,
                                    "turn within the play of the seat"};
// how a mating drags its fixed part along (release.h)
inline constexpr ErrorKind kDrag = {"drag", domain::Dimension::kLength,
                                    "shift as the mating drags the part along"};
inline constexpr ErrorKind kThetaDrag = {"theta_drag", domain::Dimension::kAngle,
                                         "turn as the mating drags the part along"};
// rests of affine forms (uncertain_world.h)
inline constexpr ErrorKind kRest = {"rest", domain::Dimension::kLength,
                                    "remainder of an expression that was shortened"};
inline constexpr ErrorKind kThetaRest = {"theta_rest", domain::Dimension::kAngle,
                                         "remainder of an expression that was shortened"};

}  // namespace error

std::span<const ErrorKind* const> KnownErrors();

// Returns the kind whose variables have names like this one, or null if there is none. If several
// stems fit, the longest stem counts.
const ErrorKind* ErrorKindOf(std::string_view variable);

}  // namespace assay::plan
