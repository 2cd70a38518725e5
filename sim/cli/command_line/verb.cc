#include "sim/cli/command_line/verb.h"

#include <array>

namespace assay::cli {

std::span<const Verb* const> Verbs() {
  static constexpr std::array kVerbs = {
      &kInit,   &kImport,    &kCheck, &kPlan,   &kRun,    &kMate,      &kContingent, &kSweep,
      &kReplay, &kReport,    &kView,  &kFilm,   &kRender, &kExport,    &kBudget,     &kLabel,
      &kBound,  &kCalibrate, &kTune,  &kDoctor, &kList,   &kCompletion};
  return kVerbs;
}

}  // namespace assay::cli
