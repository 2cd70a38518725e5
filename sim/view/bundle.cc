#include "sim/view/bundle.h"

// The assembler includes the file that the build has made (CMakeLists.txt). As a string literal,
// the file would be longer than compilers must accept.
asm(".section .rodata\n"
    ".global assay_view_bundle\n"
    ".global assay_view_bundle_end\n"
    "assay_view_bundle:\n"
    ".incbin \"" ASSAY_VIEW_BUNDLE
    "\"\n"
    "assay_view_bundle_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" {
extern const char assay_view_bundle[];
extern const char assay_view_bundle_end[];
}

namespace assay::view {

std::string_view Bundle() { return {assay_view_bundle, assay_view_bundle_end}; }

}  // namespace assay::view
