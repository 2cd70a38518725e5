#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/report/page/element.h"

namespace assay::report {

// What a page tells of the fine motion of a mating.
struct MatingSubject {
  struct Motion {
    std::string ends_with;
    std::string contacts;  // after it
    std::string unwanted;  // that comes first with enlarged errors
  };
  struct Picture {
    std::string caption;
    std::string png;  // the contents of the file
  };

  // What physics says of the plan's margins.
  struct Trials {
    // Of a contact that must not happen, within the ladder or one that happened.
    struct Ranked {
      std::string motion;
      std::string contact;
      std::string scale;  // the least enlargement of the errors at which it happens
      std::string happened;
    };
    std::string outcome;  // a line
    std::string ranking;  // a line: how well margins and frequencies agree
    std::vector<Ranked> contacts;
  };

  std::string title;
  std::string summary;               // a line
  std::vector<Element> graphs = {};  // ContactGraphPicture of each critical point
  std::vector<Motion> motions = {};
  std::vector<Picture> pictures = {};  // of contact states
  std::optional<Trials> trials = {};   // none were made
};

// One HTML page, complete in itself, as Page: the contact graphs beside the table of motions, the
// pictures of the states that these lead to, and what trials say of the margins.
std::string MatingPage(MatingSubject subject);

}  // namespace assay::report
