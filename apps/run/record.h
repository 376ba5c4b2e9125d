// The record of a run: history.csv and cracks.csv row by row, the results that are made of them, and the
// tables that follow once the test has ended.
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "apps/output/csv_writer.h"
#include "apps/output/output_folder.h"
#include "apps/run/history.h"
#include "apps/run/observer.h"
#include "apps/run/results.h"
#include "apps/scene/scene.h"

namespace platen::apps {

class Record : public Observer {
public:
  // All but `sampler` must outlive it.
  Record(const Scene &scene, coupling::PlatenTest &test, Results &results, const OutputPaths &paths,
         Sampler sampler, double expected_steps);

  // A new run: the specimen as it was packed, where the run does not begin there, and as it is.
  void begin(const std::optional<Sample> &as_packed);
  // Goes on after what a checkpoint marks. Throws CheckpointError where the tables are not those of the run.
  void resume(const FileMarks &marks);
  // The same errors, before anything is changed. `checkpoint`: its file.
  void require_tables(const FileMarks &marks, const std::string &checkpoint) const;
  // Called after each row of history.csv.
  void listen(std::function<void(const Sample &)> listener) { listener_ = std::move(listener); }

  double steps_until_due() const override { return rows_.steps_until_due(); }
  Gathered needs() const override { return rows_.is_due() ? Gathered::motion : Gathered::nothing; }
  void observe(const Moment &now) override;
  void mark(FileMarks &marks) override;
  void finish() override;

private:
  void keep(const Sample &sample);
  void write_cracks();
  void write_bond_stress() const;
  void write_events() const;
  void write_crack_state() const;

  const Scene &scene_;
  coupling::PlatenTest &test_;
  Results &results_;
  const OutputPaths &paths_;
  Sampler sampler_;
  Schedule rows_;
  std::optional<CsvWriter> history_, cracks_;
  std::function<void(const Sample &)> listener_;
};

} // namespace platen::apps
