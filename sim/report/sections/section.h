#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/report/findings/findings.h"
#include "sim/report/html/element.h"
#include "sim/report/sections/cell_name.h"
#include "sim/report/sections/view_link.h"

namespace assay::report {

// The data from which the sections of a page are made.
struct Subject {
  const Findings& findings;
  std::vector<CellAxis> axes;                // the axes on which the cells differ
  std::vector<const CellFindings*> in_full;  // cells whose certificates are shown step by step
  ViewMaker view = {};                       // may be empty

  std::string NameOf(const CellFindings& cell) const { return CellName(cell.cell(), axes); }
  // Returns the number of cells that have certificates and are not shown step by step.
  int left_out() const;
};

// Returns the subject of the findings with at most `most` cells shown step by step, in the order of
// the grid. Cells with a violation are chosen first, then cells with noise.
Subject SubjectOf(const Findings& findings, int most);

// A part of the page with a heading of its own. No section is empty.
struct Section {
  std::string id;
  std::string title;
  Element (*make)(const Subject& subject);
};
const std::vector<Section>& Sections();

Element SummaryOf(const Subject& subject);
Element Outcomes(const Subject& subject);
Element Failures(const Subject& subject);
Element Recoveries(const Subject& subject);
Element Verdicts(const Subject& subject);
Element ErrorSets(const Subject& subject);
Element Falsifications(const Subject& subject);
Element ConservatismRatios(const Subject& subject);
Element Setup(const Subject& subject);

// Returns pictures of the best, the typical and the worst trial.
Element Pictures(const Findings& findings, const std::function<std::string(int trial)>& picture);

}  // namespace assay::report
