#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "planner/plan/certificates/condition_table.h"
#include "sim/view/page.h"
#include "tests/browser.h"
#include "tests/scratch_file.h"
#include "tests/sim/view/viewed_execution.h"

namespace assay::view::browser_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The first step is a look without a movement, so the page begins in the second one.
constexpr const char* kUse = R"(
  const clock = () => Number(d.querySelector(".clock").textContent.split(" ")[0]);
  const step = () => d.querySelector('[aria-current="step"] .number').textContent;
  press(" "); await wait(2000); press(" ");
  const paused = clock();
  await wait(300);
  say("played", paused > 0); say("paused", clock() === paused);
  d.querySelectorAll(".steps button")[1].click();
  say("clicked", step()); say("lead", d.querySelector(".lead").textContent);
  say("claims", d.querySelectorAll(".claim").length > 5);
  const marks = [...d.querySelectorAll(".steps .mark")].map((mark) => mark.textContent);
  say("marks", marks.indexOf("✗") === 1 && marks.lastIndexOf("✗") === 1);
  say("violated", d.querySelector(".outcome.bad").textContent);
  const clicked = d.querySelectorAll(".steps button")[0];
  clicked.focus(); clicked.dispatchEvent(new w.MouseEvent("click", { bubbles: true, detail: 1 }));
  say("space plays", d.activeElement === d.body);
  press("Home"); say("home", clock());
  press("ArrowDown"); say("next", step());
  press("ArrowRight"); press("."); press("ArrowUp"); say("again", step());
  press("End"); say("end", clock() > 5);
  press("+"); say("speed", d.querySelector("select").value);
  const whole = picture();
  press("4"); say("camera", d.querySelector('.group [aria-pressed="true"]').textContent);
  const above = picture();
  press("b"); say("pictures", whole.length > 5000 && above !== whole && picture() !== above);
  const halves = () => [...d.querySelectorAll(".half")].map((half) => half.clientWidth);
  const [first, second] = halves();
  say("halves", first > 400 && Math.abs(first - second) <= 2);
  press("p"); say("beside", d.querySelector(".half[hidden]") !== null);
  say("alone", halves()[0] > 1.9 * first && halves()[1] === 0);
  press("p"); say("again beside", halves()[1] === second); press("p");
  press("?"); say("help", d.querySelector("dialog").open);
  say("overflow", d.documentElement.scrollWidth - d.documentElement.clientWidth);
)";

// Two executions beside each other. The first one violates a claim about the step that is executed
// second.
Subject TwoExecutions() {
  Subject subject = WithAnUnprovedWay().subject();
  subject.claims.push_back({.step = subject.plan.ExecutionOrder()[1],
                            .name = "x of peg",
                            .dimension = domain::Dimension::kLength,
                            .predicted = {-1e-3, 1e-3},
                            .observed = 3e-3,
                            .margin = -2e-3,
                            .verdict = check::ClaimVerdict::kViolated});
  subject.beside.emplace("the same again", WithAnUnprovedWay().scene, WithAnUnprovedWay().trace);
  return subject;
}

SeenPage Seen(const Subject& subject, const char* use) {
  const auto file = ScratchFile("subject.html");
  std::ofstream(file, std::ios::binary) << Page(subject);
  SeenPage seen = UsePage(file, use);
  EXPECT_EQ(seen.code, 0);
  EXPECT_THAT(seen.console, IsEmpty());
  EXPECT_THAT(seen.said, HasSubstr("requests=0\n"));
  return seen;
}

TEST(InBrowser, IsUsedAsPeopleDo) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed";
  const SeenPage seen = Seen(TwoExecutions(), kUse);
  for (const char* expected : {"played=true\n",
                               "paused=true\n",
                               "clicked=2\n",
                               "the arm's way not.\n",
                               "claims=true\n",
                               "marks=true\n",
                               "violated=Violated claims: step 2 (x of peg)\n",
                               "space plays=true\n",
                               "home=0",
                               "next=3\n",
                               "again=3\n",
                               "end=true\n",
                               "speed=2\n",
                               "camera=top\n",
                               "pictures=true\n",
                               "halves=true\n",
                               "beside=true\n",
                               "alone=true\n",
                               "again beside=true\n",
                               "help=true\n",
                               "overflow=0\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
}

// While the peg is held, the page shows the contacts of the fingers and their forces. It also
// writes the force beside a contact that the pointer is on. The forces of the two fingers are
// opposite, so the sum of the arrows on the peg is small.
TEST(InBrowser, ShowsContactsWithTheirForces) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed";
  const SeenPage seen = Seen(Figure15().subject(), R"(
  const { player, viewport } = w.assayView;
  const pickup = [...d.querySelectorAll(".steps button")].findIndex(
      (button) => button.textContent.includes("assemble"));
  d.querySelectorAll(".steps button")[pickup].click();
  player.seek(player.time + 0.5);
  const { contacts, surface } = viewport.picture;
  const fingers = contacts.marks.filter(
      ({ pair }) => pair.names[0].includes("finger") && pair.names[1] === "part/peg");
  say("points", fingers.length >= 4);
  const norm = (vector) => Math.hypot(vector.x, vector.y, vector.z);
  const forces = fingers.map(({ force }) => norm(force));
  const sum = fingers.reduce((all, { force }) => all.clone().add(force), fingers[0].force.clone().multiplyScalar(0));
  const whole = forces.reduce((a, b) => a + b);
  say("grips", whole > 100); say("opposite", norm(sum) < 0.05 * whole);
  say("reading", /finger_left – peg \(\d+\.\d\sN\)/.test(d.querySelector(".readings").textContent));
  press("1"); picture();
  const seenAt = fingers[0].at.clone().project(viewport.camera);
  const { left, top } = surface.getBoundingClientRect();
  surface.dispatchEvent(new w.PointerEvent("pointermove", {
    bubbles: true, clientX: left + ((seenAt.x + 1) / 2) * surface.clientWidth,
    clientY: top + ((1 - seenAt.y) / 2) * surface.clientHeight }));
  say("note", d.querySelector(".contact-note").textContent);
  const shown = picture();
  press("c"); say("hidden", picture() !== shown);
)");
  for (const char* expected : {"points=true\n", "grips=true\n", "opposite=true\n", "reading=true\n",
                               "note=force on peg from ", "hidden=true\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
}

// A trace of an earlier version has no contact points. Its page shows all else.
TEST(InBrowser, ShowsATraceWithoutContactPoints) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed";
  execution::Trace trace = Figure15().trace;
  for (execution::TraceEvent& event : trace.events) {
    if (auto* sample = std::get_if<execution::Sample>(&event)) sample->contact_points.reset();
  }
  const SeenPage seen = Seen({.problem = Figure15().scenario.problem,
                              .plan = Figure15().plan,
                              .scene = Figure15().scene,
                              .trace = trace,
                              .outcome = "succeeded",
                              .plan_file = "test"},
                             R"(
  say("toggles", [...d.querySelectorAll(".toggle")].map((one) => one.textContent).join());
  press("End"); press("c"); say("drawn", picture().length > 5000);
  say("touching", d.querySelector(".readings").textContent.includes("touching: block – peg"));
)");
  for (const char* expected :
       {"toggles=believed poses,predicted errors\n", "drawn=true\n", "touching=true\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
}

// The button of a precondition that is not proved leads to the place where it is decided, and draws
// the outline of the hole there. Another step takes the outline away.
TEST(InBrowser, ShowsWhereAPreconditionIsNotProved) {
  if (!HasChromium()) GTEST_SKIP() << "chromium is not installed";
  plan::Plan plan = Figure15().plan;
  const plan::StepId last = plan.ExecutionOrder().back();
  auto& claims = plan.steps[last.index()].certificate.preconditions;
  std::ranges::find(claims, plan::Condition(plan::condition::kEntry),
                    &plan::CertifiedPrecondition::condition)
      ->margin = -1e-3;
  const Subject subject = Figure15().subject();
  const SeenPage seen = Seen({.problem = subject.problem,
                              .plan = plan,
                              .scene = subject.scene,
                              .trace = subject.trace,
                              .outcome = "succeeded",
                              .plan_file = "test"},
                             R"(
  const { player, viewport } = w.assayView;
  const { pointers } = viewport.picture;
  const begin = () => d.querySelector("header .where").click();
  begin(); say("goes to", d.querySelector('[aria-current="step"] .action').textContent);
  const from = player.time; const plain = picture();
  d.querySelector(".detail .where").click();
  say("later", player.time > from + 1); say("lines", pointers.root.children.length > 0);
  say("seen", picture() !== plain);
  d.querySelectorAll(".steps button")[0].click();
  say("gone", pointers.root.children.length === 0);
)");
  for (const char* expected : {"goes to=assemble(peg, block)\n", "later=true\n", "lines=true\n",
                               "seen=true\n", "gone=true\n"}) {
    EXPECT_THAT(seen.said, HasSubstr(expected));
  }
}

}  // namespace
}  // namespace assay::view::browser_test
