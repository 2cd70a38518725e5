#include <mimalloc.h>

// This file is linked into the programs that use the allocator (assay_allocator in CMakeLists.txt).

namespace {

// A plan uses several megabytes. Pages of two megabytes cause a fifth of the page faults of pages
// of four kilobytes. With small pages, page faults took a third of the time of a small plan (on a
// virtual machine, where they are expensive). If the system has no large pages, this has no effect.
void AskForLargePages() { mi_option_enable(mi_option_large_os_pages); }

// The allocator uses this option at its first request. That is before main and before static
// variables are initialized, so the function must run before both.
[[gnu::section(".preinit_array"), gnu::used]] void (*const kBeforeAllElse)() = AskForLargePages;

}  // namespace
