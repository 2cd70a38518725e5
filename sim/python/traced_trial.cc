#include "sim/python/traced_trial.h"

#include <sstream>

#include "sim/cli/page_output/execution_page.h"

namespace assay::python {

std::string TracedTrial::Lines() const {
  std::ostringstream text;
  execution::WriteTrace(shown_.trace, text);
  return text.str();
}

std::string TracedTrial::Page() const { return cli::ExecutionPage(shown_); }

}  // namespace assay::python
