#include "sim/sweep/database/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "planner/base/input_files/input_error.h"
#include "sim/sweep/runner/machine.h"
#include "tests/sim/sweep/false_work.h"
#include "tests/sim/sweep/sweep_folder.h"

namespace assay::sweep::store_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Returns the message of the exception that the call throws.
template <class Error>
std::string MessageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class StoreTest : public SweepFolder {
 protected:
  StoreTest()
      : sweep_(Read("scenarios: [a.yaml]\nnoise: [none, uniform]\ntrials: 20\n")),
        facts_(FactsOf(sweep_, "1.2.3")),
        cells_(Cells(sweep_)) {}

  TimedTrial Trial(int number) const {
    const TrialPlace place = PlaceOf(cells_, number);
    TimedTrial timed = FalseTrial({cells_[place.cell], {}, nullptr}, place.number);
    timed.record.trial = number;
    timed.record.cell = cells_[place.cell].number;
    timed.record.number = place.number;
    return timed;
  }
  std::vector<TimedTrial> Trials(int first, int last) const {
    std::vector<TimedTrial> trials;
    for (int i = first; i <= last; ++i) trials.push_back(Trial(i));
    return trials;
  }
  void AddCells(Store& store) const {
    std::vector<CellRecord> cells;
    for (const Cell& cell : cells_) cells.push_back(FalseCell(cell));
    store.Add(cells, 0.25);
  }
  // Writes a whole database.
  void Fill(const fs::path& file) const {
    Store store = Store::Create(file, facts_);
    AddCells(store);
    store.Add(Trials(1, TrialCount(cells_)));
    store.Close();
  }

  const Sweep sweep_;
  const SweepFacts facts_;
  const std::vector<Cell> cells_;
  const fs::path file_ = folder_ / "sweep.sqlite";
};

TEST_F(StoreTest, TrialsAreReadAsTheyWereWritten) {
  Fill(file_);
  const Store store = Store::Open(file_);
  for (int i = 1; i <= TrialCount(cells_); ++i) EXPECT_EQ(store.FindTrial(i), Trial(i).record);
  EXPECT_EQ(store.FindTrial(0), std::nullopt);
  EXPECT_EQ(store.FindTrial(TrialCount(cells_) + 1), std::nullopt);
}

struct Tampering {
  const char* sql;
  const char* message;
};

// Each change makes a database that this program cannot have written.
TEST_F(StoreTest, WhatCannotBeIsRefusedWhenItIsOpened) {
  for (const Tampering& tampering : {
           Tampering{"UPDATE sweep SET value = 'x' WHERE key = 'trials'", "the sweep has x trials"},
           Tampering{"UPDATE sweep SET value = '-1' WHERE key = 'trials'", "has -1 trials"},
           Tampering{"UPDATE sweep SET value = '99999999999999999999' WHERE key = 'trials'",
                     "99999999999999999999 trials"},
           Tampering{"DELETE FROM sweep WHERE key = 'path'", "the sweep has no path"},
           Tampering{"UPDATE sweep SET value = x'ff' WHERE key = 'text'",
                     "column value of table sweep has 1 values of another type"},
           Tampering{"UPDATE cell SET clearance = 'wide'", "column clearance of table cell"},
           Tampering{"UPDATE cell SET outcome = 'fine'", "the outcome fine"},
           Tampering{"UPDATE cell SET noise = 'loud'", "the noise loud"},
           Tampering{"UPDATE trial SET outcome = 'dancing'", "the outcome dancing"},
           Tampering{"UPDATE sweep SET value = 'assay-sweep/9' WHERE key = 'format'",
                     "the format assay-sweep/9"},
           Tampering{"UPDATE trial SET number = 'one' WHERE trial = 3",
                     "column number of table trial"},
           Tampering{"UPDATE trial SET number = 0 WHERE trial = 3", "trial 3, number 0"},
           Tampering{"UPDATE trial SET contained = -1 WHERE trial = 3", "counts below 0"},
           Tampering{"PRAGMA foreign_keys = OFF; UPDATE trial SET cell = 77 WHERE trial = 3",
                     "a row of table trial belongs to no row of table cell"},
           Tampering{"PRAGMA foreign_keys = OFF; DELETE FROM trial WHERE trial = 3",
                     "belongs to no row of table trial"},
           Tampering{
               "INSERT INTO trial SELECT 21000, cell, number, noise, outcome, reason, simulated,"
               " steps, errors_signalled, recovered, operator_called, warnings, contained,"
               " inconclusive, violated, not_claimed, replay FROM trial WHERE trial = 3",
               "there is a trial 21000"},
           Tampering{"UPDATE verdict SET verdict = 'proved'", "is proved"},
           Tampering{"ALTER TABLE trial RENAME COLUMN outcome TO result", "CREATE TABLE trial"},
           Tampering{"ALTER TABLE cell ADD COLUMN more", "CREATE TABLE cell"},
           Tampering{"DROP TABLE observation", "CREATE TABLE observation"},
           Tampering{"DROP INDEX trial_of_cell", "CREATE INDEX trial_of_cell"},
       }) {
    fs::remove(file_);
    Fill(file_);
    Database(file_, Database::Access::kWrite).Execute(tampering.sql);
    for (const auto& open : {std::function<void()>([&] { Store::Open(file_); }),
                             std::function<void()>([&] { Store::Resume(file_, facts_); })}) {
      EXPECT_THAT(
          MessageOf<InputError>(open),
          AllOf(HasSubstr(file_.string()), HasSubstr("allowed: "), HasSubstr(tampering.message)))
          << tampering.sql;
    }
  }
}

TEST_F(StoreTest, NumbersThatDoNotFitAreRefused) {
  Fill(file_);
  Database(file_, Database::Access::kWrite).Execute("UPDATE trial SET recovered = 1 << 40");
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Open(file_).FindTrial(1); }),
              HasSubstr("recovered is 1099511627776; allowed: "));
}

// SQLite takes this name for a database in memory.
TEST_F(StoreTest, AFileMayHaveAnyName) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  Fill(":memory:");
  EXPECT_EQ(Store::Open(":memory:").Trials().size(), 21u);
  fs::current_path(before);
  EXPECT_TRUE(fs::is_regular_file(folder_ / ":memory:"));
}

TEST_F(StoreTest, CellsAreReadAsTheyWereWritten) {
  Fill(file_);
  const std::vector<CellRecord> stored = Store::Open(file_).Cells();
  ASSERT_EQ(stored.size(), cells_.size());
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const CellRecord written = FalseCell(cells_[i]);
    EXPECT_EQ(stored[i].cell, written.cell);
    EXPECT_EQ(stored[i].noise, written.noise);
    EXPECT_EQ(stored[i].clearance, written.clearance);
    EXPECT_EQ(stored[i].plan, written.plan);
    EXPECT_EQ(stored[i].outcome, "planned");
    EXPECT_EQ(stored[i].trials, written.trials);
    ASSERT_EQ(stored[i].gate.steps.size(), 2u);
    EXPECT_EQ(stored[i].gate.steps[0].arm, written.gate.steps[0].arm);
    EXPECT_EQ(stored[i].gate.steps[0].penetration, written.gate.steps[0].penetration);
    ASSERT_EQ(stored[i].gate.steps[0].components.size(), 2u);
    for (int c = 0; c < 2; ++c) {
      const check::ClaimNoiseFloor& read = stored[i].gate.steps[0].components[c];
      const check::ClaimNoiseFloor& component = written.gate.steps[0].components[c];
      EXPECT_EQ(read.about, component.about);
      EXPECT_EQ(read.name, component.name);
      EXPECT_EQ(read.offset, component.offset);
      EXPECT_EQ(read.step_size, component.step_size);
    }
    EXPECT_EQ(stored[i].gate.steps[1].lag_turn, written.gate.steps[1].lag_turn);
  }
}

// The claims have infinite ends, too.
TEST_F(StoreTest, ClaimsAreKeptOncePerCell) {
  Fill(file_);
  const Store store = Store::Open(file_);
  for (const Cell& cell : cells_) EXPECT_EQ(store.Claims(cell.number), Trial(1).claims);
}

// The records have infinite ends, missing ratios, and a command with quotes in it.
TEST_F(StoreTest, FalsificationsAreReadAsTheyWereWritten) {
  const Sweep sweep =
      Read("scenarios: [a.yaml, b.yaml]\nnoise: [attack]\nerror_scales: [1, 2, 3]\n");
  const std::vector<Cell> cells = Cells(sweep);
  Store store = Store::Create(file_, FactsOf(sweep, "1"));
  int violated = 0;
  for (const Cell& cell : cells) {
    store.Add({FalseCell(cell)}, 0.25);
    EXPECT_EQ(store.FindFalsification(cell.number), std::nullopt);
    TimedTrial timed = MadeUpFalsification({cell, {}, nullptr}, {});
    timed.record.trial = cell.first_trial;
    timed.record.cell = cell.number;
    timed.record.number = 1;
    store.Add({timed});
    EXPECT_EQ(store.FindTrial(cell.first_trial), timed.record);
    EXPECT_EQ(store.FindFalsification(cell.number), MadeUpFalsificationRecord(cell));
    violated += timed.record.outcome == "violated";
  }
  EXPECT_GT(violated, 0);
  EXPECT_LT(violated, static_cast<int>(cells.size()));
  EXPECT_EQ(store.database().Integer("SELECT count(*) FROM conservatism WHERE broken IS NULL"),
            static_cast<int>(cells.size()) - violated);
  EXPECT_EQ(store.MeanSeconds(), 0);  // only other trials count
}

// Programs that read the database depend on these columns.
TEST_F(StoreTest, TablesOfFalsificationsHaveTheirColumns) {
  const Store store = Store::Create(file_, facts_);
  const std::map<std::string, std::string> columns = {
      {"attack",
       "cell,attempts,contained,inconclusive,violated,not_claimed,claims_contained,"
       "claims_inconclusive,claims_violated,claims_not_claimed"},
      {"attack_worst",
       "cell,claim,step,action,about,name,unit,observed,low,high,margin,gate,verdict,phase,attempt,"
       "noise"},
      {"counterexample",
       "cell,number,claim,action,name,unit,observed,low,high,margin,gate,noise,steps,replayed,"
       "multiple,replay"},
      {"conservatism", "cell,variable,guaranteed,broken,ratio"}};
  for (const auto& [table, names] : columns) {
    Statement row = store.database().Prepare("SELECT group_concat(name) FROM pragma_table_info(?)");
    row.Bind(table);
    ASSERT_TRUE(row.Next());
    EXPECT_EQ(row.Text(0), names) << table;
  }
}

TEST_F(StoreTest, FactsAndRunsAreRead) {
  {
    Store store = Store::Create(file_, facts_);
    store.Add(ThisRun("1.2.3", "1/5", 1));
    store.Add(ThisRun("1.2.3", "2/5", 4));
    store.Finish({.trials = 3, .steps = 600, .seconds = 1.5});
  }
  const Store store = Store::Open(file_);
  EXPECT_EQ(store.Facts(), facts_);
  EXPECT_EQ(store.Facts().at("text"), sweep_.text);
  EXPECT_EQ(store.Facts().at("trials"), "21");
  ASSERT_EQ(store.Runs().size(), 2u);
  EXPECT_EQ(store.Runs()[0].throughput.trials, 0);
  EXPECT_EQ(store.Runs()[1].shard, "2/5");
  EXPECT_EQ(store.Runs()[1].jobs, 4);
  EXPECT_EQ(store.Runs()[1].throughput.trials, 3);
  EXPECT_EQ(store.Runs()[1].throughput.StepsPerSecond(), 400);
  EXPECT_GE(store.Runs()[0].cores, 1);
  EXPECT_THAT(store.Runs()[0].started, ::testing::MatchesRegex("....-..-..T..:..:..Z"));
}

TEST_F(StoreTest, ABatchWithATrialTwiceIsNotWrittenAtAll) {
  Store store = Store::Create(file_, facts_);
  AddCells(store);
  store.Add(Trials(1, 3));
  EXPECT_THAT(MessageOf<EnvironmentError>([&] { store.Add(Trials(3, 6)); }),
              HasSubstr("is another program doing the same sweep?"));
  EXPECT_THAT(store.Trials(), ElementsAre(1, 2, 3));
  store.Add(Trials(4, 6));
  EXPECT_EQ(store.Trials().size(), 6u);
}

TEST_F(StoreTest, ATrialOfNoCellIsRefused) {
  Store store = Store::Create(file_, facts_);
  EXPECT_THROW(store.Add(Trials(1, 1)), EnvironmentError);
}

TEST_F(StoreTest, ReadersSeeWhatIsWrittenMeanwhile) {
  Store store = Store::Create(file_, facts_);
  AddCells(store);
  store.Add(Trials(1, 3));
  EXPECT_EQ(Store::Open(file_).Trials().size(), 3u);
  store.Add(Trials(4, 4));
  EXPECT_EQ(Store::Open(file_).Trials().size(), 4u);
}

TEST_F(StoreTest, AClosedOneIsASingleFile) {
  Fill(file_);
  EXPECT_TRUE(fs::exists(file_));
  EXPECT_FALSE(fs::exists(file_.string() + "-wal"));
  EXPECT_FALSE(fs::exists(file_.string() + "-shm"));
}

TEST_F(StoreTest, AnExistingFileIsNotOverwritten) {
  Fill(file_);
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Create(file_, facts_); }),
              AllOf(HasSubstr("sweep.sqlite"), HasSubstr("--resume")));
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Create(Write("letter", "dear"), facts_); }),
              HasSubstr("letter"));
}

TEST_F(StoreTest, AnotherSweepIsNotGoneOnWith) {
  Fill(file_);
  const auto refusal = [&](const std::string& key) {
    SweepFacts facts = facts_;
    facts[key] += "x";
    return MessageOf<InputError>([&] { Store::Resume(file_, facts); });
  };
  EXPECT_THAT(refusal("text"),
              AllOf(HasSubstr("sweep.sqlite"), HasSubstr("sweep file has changed")));
  EXPECT_THAT(refusal("version"), HasSubstr("another version"));
  EXPECT_THAT(refusal("scenario a.yaml"), HasSubstr("a.yaml has changed"));
  EXPECT_EQ(Store::Resume(file_, facts_).Trials().size(), 21u);
}

// A program that is killed before it begins leaves an empty file.
TEST_F(StoreTest, AnEmptyOneIsBegun) {
  Write("sweep.sqlite", "");
  EXPECT_THAT(Store::Resume(file_, facts_).Trials(), IsEmpty());
  Database(folder_ / "blank.sqlite", Database::Access::kWrite).Execute("PRAGMA journal_mode = WAL");
  EXPECT_THAT(Store::Resume(folder_ / "blank.sqlite", facts_).Trials(), IsEmpty());
}

TEST_F(StoreTest, WhatIsNoDatabaseIsRefused) {
  const fs::path text = Write("text.sqlite", std::string(10'000, 'x'));
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Open(text); }),
              AllOf(HasSubstr("text.sqlite"), HasSubstr("not a database")));
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Resume(text, facts_); }),
              HasSubstr("not a database"));
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Open(folder_ / "nothing.sqlite"); }),
              HasSubstr("nothing.sqlite"));
  EXPECT_FALSE(fs::exists(folder_ / "nothing.sqlite"));
}

TEST_F(StoreTest, AnotherProgramsDatabaseIsRefused) {
  const fs::path other = folder_ / "other.sqlite";
  Database(other, Database::Access::kWrite).Execute("CREATE TABLE song(name TEXT)");
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Open(other); }), HasSubstr("another program"));
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Resume(other, facts_); }),
              HasSubstr("another program"));
}

TEST_F(StoreTest, AnotherFormatIsRefused) {
  Fill(file_);
  Database(file_, Database::Access::kWrite).Execute("PRAGMA user_version = 99");
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Open(file_); }),
              AllOf(HasSubstr("99"), HasSubstr("newer")));
}

TEST_F(StoreTest, AnOlderFormatIsRefusedWithWhatToDo) {
  Fill(file_);
  Database(file_, Database::Access::kWrite).Execute("PRAGMA user_version = 1");
  const auto refusal = AllOf(HasSubstr("sweep.sqlite"), HasSubstr("version 1 of the format"),
                             HasSubstr("older"), HasSubstr("do the sweep again"));
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Open(file_); }), refusal);
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Resume(file_, facts_); }), refusal);
}

TEST_F(StoreTest, ADamagedOneIsRefused) {
  Fill(file_);
  const auto size = static_cast<std::streamoff>(fs::file_size(file_));
  {
    std::fstream file(file_, std::ios::binary | std::ios::in | std::ios::out);
    for (std::streamoff page = 4096; page + 4096 <= size; page += 4096) {
      file.seekp(page);
      file << std::string(256, '\xee');
    }
  }
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Open(file_); }),
              AllOf(HasSubstr("sweep.sqlite"), HasSubstr("damaged")));
  EXPECT_THAT(MessageOf<InputError>([&] { Store::Resume(file_, facts_); }), HasSubstr("damaged"));
}

TEST_F(StoreTest, ATruncatedOneIsRefused) {
  Fill(file_);
  fs::resize_file(file_, fs::file_size(file_) / 2);
  EXPECT_THROW(Store::Open(file_), InputError);
}

TEST_F(StoreTest, NoFolderIsTold) {
  EXPECT_THAT(
      MessageOf<EnvironmentError>([&] { Store::Create(folder_ / "no/such/sweep.sqlite", facts_); }),
      AllOf(HasSubstr("no/such/sweep.sqlite"), HasSubstr("folder")));
}

TEST_F(StoreTest, AFullDiskLosesNothingThatWasWritten) {
  Store store = Store::Create(file_, facts_);
  AddCells(store);
  store.Add(Trials(1, 3));
  // SQLite takes the present number of pages as the limit instead.
  store.database().Prepare("PRAGMA max_page_count = 1").Next();
  const std::string message = MessageOf<EnvironmentError>([&] {
    for (int i = 4; i <= TrialCount(cells_); ++i) {
      TimedTrial trial = Trial(i);
      trial.record.reason = std::string(5000, 'r');
      store.Add({trial});
    }
  });
  EXPECT_THAT(message,
              AllOf(HasSubstr("sweep.sqlite"), HasSubstr("no room"), HasSubstr("--resume")));
  const std::vector<int> kept = store.Trials();
  EXPECT_EQ(Store::Open(file_).Trials(), kept);
  EXPECT_GE(kept.size(), 3u);
  EXPECT_LT(kept.size(), 21u);
}

TEST_F(StoreTest, HasOneWriterAtATime) {
  Fill(file_);
  {
    const Store writing = Store::Resume(file_, facts_);
    EXPECT_THAT(MessageOf<EnvironmentError>([&] { Store::Resume(file_, facts_); }),
                AllOf(HasSubstr("sweep.sqlite"), HasSubstr("locked by another program")));
    EXPECT_EQ(Store::Open(file_).Trials(), writing.Trials());
  }
  Store::Resume(file_, facts_);
}

}  // namespace
}  // namespace assay::sweep::store_test
