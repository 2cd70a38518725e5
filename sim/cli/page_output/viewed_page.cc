#include "sim/cli/page_output/viewed_page.h"

namespace assay::cli {

ViewedPage PageOf(const view::Subject& subject) {
  return {view::Page(subject), subject.trace.end().snapshot.time};
}

}  // namespace assay::cli
