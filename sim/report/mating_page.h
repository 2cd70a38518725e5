#pragma once

#include <string>
#include <vector>

#include "sim/report/element.h"

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

  std::string title;
  std::string summary;               // a line
  std::vector<Element> graphs = {};  // ContactGraphPicture of each critical point
  std::vector<Motion> motions = {};
  std::vector<Picture> pictures = {};  // of contact states
};

// One HTML page, complete in itself, as Page: the contact graphs beside the table of motions, and
// the pictures of the states that these lead to.
std::string MatingPage(MatingSubject subject);

}  // namespace assay::report
