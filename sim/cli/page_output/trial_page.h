#pragma once

#include <string>

#include "sim/check/trial_verdicts/trial.h"
#include "sim/cli/page_output/viewed_page.h"

namespace assay::cli {

// Makes the page of a trial under noise. The plan is executed once more without noise, and shown
// beside the trial. The trial must have samples. `source` and `plan_file` are as in view::Subject.
ViewedPage TrialPage(const check::Experiment& experiment, const check::Trial& trial,
                     const std::string& source, const std::string& plan_file);

}  // namespace assay::cli
