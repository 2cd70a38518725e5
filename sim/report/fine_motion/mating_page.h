#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/report/html/element.h"

namespace assay::report {

// The contents of a page about the fine motion of a mating.
struct MatingSubject {
  struct Motion {
    std::string ends_with;
    std::string contacts;  // the contacts after the motion
    std::string unwanted;  // the unwanted contact that happens first if errors are enlarged
  };
  struct Picture {
    std::string caption;
    std::string png;  // the contents of the file
  };

  // The findings of simulated trials about the margins of the plan.
  struct Trials {
    // A contact that must not happen. It is listed if some tested enlargement of the errors leads
    // to it, or if it happened.
    struct Ranked {
      std::string motion;
      std::string contact;
      std::string scale;  // the least enlargement of the errors at which it is predicted
      std::string happened;
    };
    std::string outcome;  // one line
    std::string ranking;  // one line about how well margins and frequencies agree
    std::vector<Ranked> contacts;
  };

  std::string title;
  std::string summary;               // one line
  std::vector<Element> graphs = {};  // one ContactGraphPicture for each critical point
  std::vector<Motion> motions = {};
  std::vector<Picture> pictures = {};  // pictures of contact states
  std::optional<Trials> trials = {};   // none if no trials were made
};

// Returns a self-contained HTML page. It shows the contact graphs beside the table of motions,
// pictures of the states in which the motions end, and what trials show about the margins.
std::string MatingPage(MatingSubject subject);

}  // namespace assay::report
