#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/certificates/condition.h"

namespace assay::plan {

// The kinds of preconditions that the planner states. The functions that derive them are in
// planner/uncertainty/preconditions/derivation.h; the kinds about the arm's way are derived in
// planner/assembly/travel/way_conditions.h. The simulator measures them by the functions in
// sim/check/measurements/measurement.h.
namespace condition {

using domain::Dimension;

inline constexpr std::string_view kNothingNear = "no other part is near enough to be met";
inline constexpr std::string_view kNamedAsNotCovered =
    "it is not proved, and the plan names the step among what is not covered";

// ---- Closing the pads ------------------------------------------------------------------------

// Spar's four ("Derivation of Uncertainty-Reduction Goals"): 0 < y(P1^-1 C1), y(P1^-1 C2) and
// y(P2^-1 C1), y(P2^-1 C2) < 0, where P1 and P2 are the possible frames of the fingers, and C1 and
// C2 the possible contacts.
inline constexpr ConditionKind kBetweenFingers = {
    "between fingers", "both contacts lie between the pads when these begin to close",
    Dimension::kLength, NeededBy::kGrasp, Origin::kPaper};

// The inner corners of the open fingers' pads lie outside the planes of the faces that they are to
// close on.
inline constexpr ConditionKind kFingerClear = {"finger clear", "no finger comes down on the part",
                                               Dimension::kLength, NeededBy::kGrasp,
                                               Origin::kSoundMode};

// As pads close, the fingers stay above the table. As they let a part go, the fingers stay above
// the table, and above or beside what the part stands on.
inline constexpr ConditionKind kFingertip = {
    "fingertip", "the fingers stay above the table and clear of what a part is set on",
    Dimension::kLength, NeededBy::kHandWork, Origin::kSoundMode};

inline constexpr ConditionKind kPadContact = {
    "pad contact", "the grasped point stays inside the closed pads, by the workcell's margin",
    Dimension::kLength, NeededBy::kGrasp, Origin::kSoundMode};

// The push that overcomes the friction at the part's support, divided by the force of the grip, is
// below 1. The moment of this push about every edge on which the part stands, divided by the moment
// of the part's weight, is below 1, too.
inline constexpr ConditionKind kUpright = {
    "upright", "the part slides before a closing pad and does not topple", Dimension::kRatio,
    NeededBy::kGrasp, Origin::kSoundMode};

inline constexpr ConditionKind kPushedClear = {
    "pushed clear",     "closing pads push the part into no neighbour",
    Dimension::kLength, NeededBy::kGrasp,
    Origin::kSoundMode, AbsorbedBy::kNothing,
    kNothingNear};

// ---- Putting a part down ---------------------------------------------------------------------

// Every vertex that is to touch the table does so within the guarded travel.
inline constexpr ConditionKind kLandingHeight = {
    "landing height", "the part meets the table within the guarded travel", Dimension::kLength,
    NeededBy::kPutdown, Origin::kPaper};

// Every vertex that is to touch the table lies on the table. This holds where the hand brings the
// part. If the part does not come upright, it also holds after the part has settled.
inline constexpr ConditionKind kFootprint = {
    "footprint",        "the part comes to stand on the table",
    Dimension::kLength, NeededBy::kPutdown,
    Origin::kPaper,     AbsorbedBy::kOtherPlace};

// A line keeps the part's footprint and each neighbour's footprint apart, where the hand brings the
// part and after the part has settled.
inline constexpr ConditionKind kNeighbourClear = {
    "neighbour clear",  "the part does not touch other parts",
    Dimension::kLength, NeededBy::kPutdown,
    Origin::kPaper,     AbsorbedBy::kNothing,
    kNothingNear};

// ---- Mating ----------------------------------------------------------------------------------

// The shaft is inside the walls of its hole when its tip is in the mouth: the tip's vertices lie
// inside the planes of the walls. Bevelled edges of the tip and of the mouth give more room. The
// planes are therefore moved outward by the widths of both bevels. The wrist yields by the
// workcell's lateral compliance across each pair of walls that face each other. The shaft may stand
// out beyond one wall of a pair by this distance. It must still be no wider than the distance
// between the two walls. Both rules also hold for kSlideIn.
inline constexpr ConditionKind kEntry = {
    "entry",
    "the shaft's tip comes into the mouth of its hole, with the bevelled edges",
    Dimension::kLength,
    NeededBy::kMating,
    Origin::kPaper,
    AbsorbedBy::kFineMotion};

// Without the bevels, the shaft's vertices lie inside the planes of the walls at the start and at
// the end of the mating motion, and at the seat.
inline constexpr ConditionKind kSlideIn = {
    "slide-in",         "the shaft stays inside the walls of its hole down to its seat",
    Dimension::kLength, NeededBy::kMating,
    Origin::kPaper,     AbsorbedBy::kFineMotion};

// The angles of two-point contact and of wedging are clearance / depth and clearance / (friction *
// width) (Whitney 1982).
inline constexpr ConditionKind kTilt = {
    "tilt",
    "the shaft leans across each pair of walls by less than makes it jam or wedge",
    Dimension::kAngle,
    NeededBy::kMating,
    Origin::kPaper,
    AbsorbedBy::kFineMotion};

inline constexpr ConditionKind kSeat = {"seat",
                                        "the part reaches its seat within the guarded travel",
                                        Dimension::kLength,
                                        NeededBy::kMating,
                                        Origin::kPaper,
                                        AbsorbedBy::kFineMotion};

// A plane keeps each piece of the held part, all along the mating motion, apart from each piece of
// every other part, and from the table, unless the motion ends on the table. Shafts in their holes
// are left out, and so are pieces of the fixed part that lie ahead even at the seat. If a strategy
// executes the mating, the motion ends where the strategy starts.
inline constexpr ConditionKind kPassingClear = {
    "passing clear",
    "the held part touches nothing before its shafts reach the mouths of their holes",
    Dimension::kLength,
    NeededBy::kMating,
    Origin::kSoundMode,
    AbsorbedBy::kNothing,
    kNothingNear};

inline constexpr ConditionKind kFixedStands = {
    "fixed stands", "the push of the mating tips neither the fixed part nor the parts under it",
    Dimension::kRatio, NeededBy::kMating, Origin::kSoundMode};

inline constexpr ConditionKind kFixedStays = {
    "fixed stays", "the push of the mating does not move the fixed part aside", Dimension::kRatio,
    NeededBy::kMating, Origin::kSoundMode};

// After the hand has let it go, the held part is off its place by less than a successful assembly
// allows (planner/domain/matings/mating_success.h). Either the walls of the holes leave no more
// room, or the errors do not reach so far.
inline constexpr ConditionKind kInPlace = {
    "in place", "the part ends as near its place as a successful assembly needs",
    Dimension::kLength, NeededBy::kMating, Origin::kSoundMode};

// Replaces the kinds that fine motion absorbs, as kTipTurn does.
inline constexpr ConditionKind kTipShift = {
    "tip shift",
    "at the strategy's start, the tip is displaced by no more than the strategy absorbs",
    Dimension::kLength, NeededBy::kStrategy, Origin::kPaper};

inline constexpr ConditionKind kTipTurn = {
    "tip turn", "at the strategy's start, the tip is turned by no more than the strategy absorbs",
    Dimension::kAngle, NeededBy::kStrategy, Origin::kPaper};

// ---- Letting a part go -----------------------------------------------------------------------

// A part that leans turns about an edge of its support. The moment that tips it over, divided by
// the moment with which it falls back, is below 1.
inline constexpr ConditionKind kStanding = {
    "standing", "once let go, the part falls back on what it stands on, however it leans",
    Dimension::kRatio, NeededBy::kRelease, Origin::kSoundMode};

inline constexpr ConditionKind kPressed = {
    "pressed", "pads that slide down on the part do not press it over an edge of its support",
    Dimension::kRatio, NeededBy::kRelease, Origin::kSoundMode};

// ---- Every step with the hand ----------------------------------------------------------------

// The load on the pads, divided by the load that they bear, is below 1. The load is weight,
// accelerations (carrying.h) and the lever from the pads to the centre of mass. The pads bear it by
// the least friction within its tolerance, under the grip force.
inline constexpr ConditionKind kHolding = {"holding", "the pads' friction bears the part",
                                           Dimension::kRatio, NeededBy::kCarrying,
                                           Origin::kSoundMode};

// A plane keeps each piece of hand and fingers apart from every part, on the straight way to where
// the pads close or open, and on the way from there. The part between the pads is tested where it
// rests before it is taken, and where it is in the hand. Its pieces behind the planes in which the
// closing pads are to touch it are left out. The fixed part of a mating, and parts beside it, are
// tested on the hand's way in the insertion, too.
inline constexpr ConditionKind kHandClear = {
    "hand clear",       "hand and fingers touch no part, except the faces on which the pads close",
    Dimension::kLength, NeededBy::kHandWork,
    Origin::kSoundMode, AbsorbedBy::kNothing,
    kNothingNear};

// ---- The arm's way ---------------------------------------------------------------------------

// The arm reaches every pose that errors may require (motion::SwayAlong).
inline constexpr ConditionKind kReach = {
    "reach",
    "joints stay within their ranges and the arm in its configuration",
    Dimension::kAngle,
    NeededBy::kWay,
    Origin::kSoundMode,
    AbsorbedBy::kNothing,
    kNamedAsNotCovered,
    "errors with which a joint comes to the end of its range, or the arm into another "
    "configuration"};

// Arm, hand and held part are clear of everything on the way, and the arm is clear on the straight
// lines of the work, wherever parts and joints are within their errors.
inline constexpr ConditionKind kWayClear = {
    "way clear",        "the arm and what it carries stay clear of everything on the way",
    Dimension::kLength, NeededBy::kWay,
    Origin::kSoundMode, AbsorbedBy::kNothing,
    kNamedAsNotCovered, "errors with which the arm touches something on its way"};

}  // namespace condition

// A list of kinds, in the order in which certificates, files and output name them.
using ConditionKinds = std::span<const ConditionKind* const>;

// Returns the kinds that the planner knows: those above. A new kind is declared above, listed in
// condition_table.cc, and named in plan.schema.json.
ConditionKinds KnownConditions();

// Returns the names of kinds, in their order.
std::vector<std::string> NamesOfConditions(ConditionKinds kinds);

// Returns the words with which the meaning of a claim ends in this circumstance; none if it is
// kUsual. Files tell the circumstance by these words alone.
std::string_view WordsOf(Circumstance circumstance);
// Returns the circumstance of a claim to which a plan file gives this meaning.
Circumstance CircumstanceOf(std::string_view meaning);

// Returns the kinds that fine motion absorbs.
const std::vector<Condition>& AbsorbedByFineMotion();

}  // namespace assay::plan
