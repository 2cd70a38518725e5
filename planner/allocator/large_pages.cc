#include <mimalloc.h>

// Compiled into the programs that have the allocator (assay_allocator in CMakeLists.txt).

namespace {

// A plan touches some megabytes. In pages of two megabytes it has a fifth of the page faults that
// it has in pages of four kilobytes, which were a third of all the time of a small plan (on a
// virtual machine, whose page faults are dear). Where the system gives no large pages, nothing
// changes.
void AskForLargePages() { mi_option_enable(mi_option_large_os_pages); }

// The allocator asks the system at the first request already: earlier than main, and than what
// initializes static variables.
[[gnu::section(".preinit_array"), gnu::used]] void (*const kBeforeAllElse)() = AskForLargePages;

}  // namespace
