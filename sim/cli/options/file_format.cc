#include "sim/cli/options/file_format.h"

namespace assay::cli {

FileFormat FormatOf(const Document& document) {
  // The names are in the order of the enum.
  static const std::vector<std::string> kNames = {
      "assay-scenario/1", "assay-part/1", "assay-workcell/1", "assay-plan/2", "assay-sweep/1"};
  return static_cast<FileFormat>(document.root().At("format").OneOf(kNames));
}

}  // namespace assay::cli
