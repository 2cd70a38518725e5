#pragma once

#include <string>
#include <vector>

#include "sim/film/subject.h"

namespace assay::film {

// The text below the pictures of a film, from the time `from` on.
struct Caption {
  double from = 0;   // simulated seconds
  std::string text;  // "3 putdown(block, on-back)"
};

// Returns the captions of an execution in the order of time, the first from its beginning: one for
// each step that was begun, and one that tells how the execution ended. A step that takes no time,
// such as a look of an arm at home, shares the caption of the next step.
std::vector<Caption> CaptionsOf(const Subject& subject);

// Returns the text of the last caption whose time has come. The captions must begin at 0 or before.
const std::string& TextAt(const std::vector<Caption>& captions, double time);

}  // namespace assay::film
