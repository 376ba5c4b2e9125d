#include "apps/run/fields.h"

#include <string>
#include <utility>

#include "apps/io/file.h"
#include "apps/io/output_folder.h"
#include "apps/io/pvtu.h"
#include "apps/io/vtu.h"
#include "apps/run/ranks.h"
#include "apps/run/view_script.h"

namespace platen::apps {
namespace {

// Pieces of bonds are then of about as many bytes as those of spheres.
constexpr std::size_t bonds_a_sphere = 4;
// A frame may wait while one is written: memory for two at most.
constexpr std::size_t frames_that_wait = 1;

} // namespace

FieldSeries::FieldSeries(const std::filesystem::path &folder, std::size_t spheres_in_a_piece, bool beside)
    : folder_(folder),
      in_a_piece_(spheres_in_a_piece),
      specimen_(folder / "specimen.pvd"),
      bonds_(folder / "bonds.pvd"),
      platens_(folder / "platens.pvd"),
      sleeve_(folder / "sleeve.pvd"),
      contacts_(folder / "contacts.pvd"),
      queue_(beside ? frames_that_wait : 0) {
  write_shared_out(1, [&](std::size_t) { create_folder(folder / "frames"); }); // before others write there
  write_text_aside(OutputPaths(folder).view(), view_script);
}

void FieldSeries::write(const coupling::PlatenTest &problem, const std::vector<int> &moves_with) {
  if (problem.time() <= last_time_) return;
  queue_.add([this, frame = frame_of(problem, moves_with, count_)] {
    store_spheres(frame);
    if (frame.has_bonds) store_bonds(frame);
    store_boundaries(frame);
    store_contacts(frame);
  });
  last_time_ = problem.time();
  ++count_;
}

void FieldSeries::resume(double last_time, int count) {
  last_time_ = last_time;
  count_ = count;
  for (PvdSeries *series : {&specimen_, &bonds_, &platens_, &sleeve_, &contacts_})
    series->resume(last_time);
}

void FieldSeries::store_spheres(const Frame &frame) {
  const Pieces pieces{frame.points.size(), in_a_piece_};
  std::string name = OutputPaths::frame_name("specimen", frame.number);
  if (pieces.count() <= 1) {
    write_points(folder_ / name, frame.time, frame.points, frame.of_spheres, frame.values);
  } else {
    name = OutputPaths::frame_of_pieces("specimen", frame.number);
    write_shared_out(pieces.count(), [&](std::size_t piece) {
      write_piece_of_points(folder_ / name, frame.time, frame.points, frame.of_spheres, frame.values, pieces,
                            piece);
    });
    write_pvtu(folder_ / name, frame.time, frame.of_spheres, {}, frame.values, pieces.count());
  }
  specimen_.append(frame.time, name);
}

void FieldSeries::store_bonds(const Frame &frame) {
  const Pieces pieces{frame.bonds.size(), bonds_a_sphere * in_a_piece_};
  std::string name = OutputPaths::frame_name("bonds", frame.number);
  if (pieces.count() <= 1) {
    write_lines(folder_ / name, frame.time, frame.points, frame.bonds, {}, frame.of_bonds, frame.values);
  } else {
    name = OutputPaths::frame_of_pieces("bonds", frame.number);
    write_shared_out(pieces.count(), [&](std::size_t piece) {
      write_piece_of_lines(folder_ / name, frame.time, frame.points, frame.bonds, frame.of_bonds,
                           frame.values, pieces, piece);
    });
    write_pvtu(folder_ / name, frame.time, {}, frame.of_bonds, frame.values, pieces.count());
  }
  bonds_.append(frame.time, name);
}

void FieldSeries::store_boundaries(const Frame &frame) {
  for (const Frame::Part &part : frame.boundaries) {
    write_text_aside(folder_ / part.file, part.vtu);
    (part.series == "platens" ? platens_ : sleeve_).append(frame.time, part.file);
  }
}

void FieldSeries::store_contacts(const Frame &frame) {
  const std::string name = OutputPaths::frame_name("contacts", frame.number);
  write_points(folder_ / name, frame.time, frame.contact_points, frame.of_contacts, frame.values);
  contacts_.append(frame.time, name);
}

} // namespace platen::apps
