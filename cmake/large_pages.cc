#include <mimalloc.h>

// Compiled into programs that have the allocator (assay_allocator in CMakeLists.txt).

namespace {

// A plan touches some megabytes, and to be given them in pages of two megabytes takes a tenth of
// the time that pages of four kilobytes take: a third of all that small plans take. Where the
// system gives none, nothing changes.
void AskForLargePages() { mi_option_enable(mi_option_large_os_pages); }

// The allocator asks the system at the first request already: earlier than main, and than what
// initializes static variables.
[[gnu::section(".preinit_array"), gnu::used]] void (*const kBeforeAllElse)() = AskForLargePages;

}  // namespace
