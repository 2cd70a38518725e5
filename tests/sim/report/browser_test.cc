#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sim/report/findings/read_findings.h"
#include "sim/report/html/page.h"
#include "tests/scratch_file.h"
#include "tests/sim/report/sample_database.h"

namespace assay::report::browser_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string TextOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The page in headless Chromium, which cannot resolve any host.
class InBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "chromium is not installed";
    }
    std::filesystem::remove(ScratchFile("sample.sqlite"));
    WriteSampleDatabase(ScratchFile("sample.sqlite"), true);
    const Findings findings =
        ReadFindings(sweep::Store::Open(ScratchFile("sample.sqlite")), "sample.sqlite");
    std::ofstream(ScratchFile("page.html"), std::ios::binary) << Page(findings, {});
  }

  // Returns the output of Chromium with these options. Its log goes to ScratchFile("log").
  static std::string Chromium(const std::string& options, const std::string& file) {
    const std::string command =
        "timeout 60 chromium --headless --no-sandbox --disable-gpu --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync "
        "--host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --user-data-dir='" +
        ScratchFile("profile").string() + "' " + options + " 'file://" +
        ScratchFile(file).string() + "' >'" + ScratchFile("out").string() + "' 2>'" +
        ScratchFile("log").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << TextOf(ScratchFile("log"));
    EXPECT_THAT(TextOf(ScratchFile("log")), Not(HasSubstr(":CONSOLE")));
    return TextOf(ScratchFile("out"));
  }

  // Writes a page that opens the report in a frame of this width and lists what the frame contains.
  static void WriteFrame(int width) {
    std::ofstream(ScratchFile("frame.html")) << R"(<!DOCTYPE html><meta charset="utf-8">
<iframe id="f" src="page.html" style="height: 900px; width: )"
                                             << width << R"(px"></iframe><pre id="seen"></pre>
<script>
window.onload = () => {
  const w = document.getElementById("f").contentWindow, d = w.document;
  const shown = e => e.getBoundingClientRect().width > 0 && e.getBoundingClientRect().height > 0;
  document.getElementById("seen").textContent = [
    "headline=" + d.querySelector(".lead").innerText,
    "overflow=" + (d.documentElement.scrollWidth - d.documentElement.clientWidth),
    "requests=" + w.performance.getEntriesByType("resource").length,
    "tables=" + d.querySelectorAll("table").length,
    "verdictrows=" + d.querySelectorAll("#verdicts tbody tr").length,
    "charts=" + [...d.querySelectorAll("#error-sets svg.chart")].filter(shown).length,
    "scripts=" + d.scripts.length,
    "h1=" + d.querySelector("h1").innerText].join("\n");
};
</script>)";
  }
};

TEST_F(InBrowser, ShowsWhatItShould) {
  const std::string page = Chromium("--dump-dom", "page.html");
  EXPECT_THAT(page, HasSubstr("Predictions were violated 3 times in 22 certificates"));
  EXPECT_THAT(page, HasSubstr("<h1>Pegs &amp; &lt;holes&gt;</h1>"));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST_F(InBrowser, FitsWideAndNarrowWindowsAndAsksForNothing) {
  for (const int width : {1280, 390}) {
    WriteFrame(width);
    const std::string seen = Chromium(
        "--allow-file-access-from-files --virtual-time-budget=3000 --dump-dom", "frame.html");
    EXPECT_THAT(seen, HasSubstr("headline=Predictions were violated 3 times")) << seen;
    EXPECT_THAT(seen, HasSubstr("overflow=0\n")) << width;
    EXPECT_THAT(seen, HasSubstr("requests=0\n"));
    EXPECT_THAT(seen, HasSubstr("verdictrows=4\n"));  // two cells of two steps
    EXPECT_THAT(seen, HasSubstr("charts=5\n"));       // one for each row, and the key
    EXPECT_THAT(seen, HasSubstr("scripts=0\n"));
    EXPECT_THAT(seen, HasSubstr("h1=Pegs &amp; &lt;holes&gt;"));
  }
}

TEST_F(InBrowser, DrawsAPicture) {
  const std::string picture = ScratchFile("page.png");
  Chromium("--window-size=800,1200 --screenshot='" + picture + "'", "page.html");
  EXPECT_GT(std::filesystem::file_size(picture), 20'000);
}

}  // namespace
}  // namespace assay::report::browser_test
