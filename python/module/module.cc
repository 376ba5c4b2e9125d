// platen._core: what platen/experiment.py makes classes of. Python's lock is given back while steps are made.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

#include "apps/run/history.h"
#include "apps/scene/errors.h"
#include "apps/scene/faults.h"
#include "apps/scene/shipped.h"
#include "apps/scene/version.h"
#include "coupling/boundary.h"
#include "python/module/experiment.h"

namespace py = pybind11;

namespace platen::python {
namespace {

// The numpy type of a column's numbers.
py::dtype type_of(const BlockType &type) {
  const char kind = type.kind == BlockType::Kind::floating         ? 'f'
                    : type.kind == BlockType::Kind::signed_integer ? 'i'
                                                                   : 'u';
  return py::dtype(std::string(1, kind) + std::to_string(type.bytes));
}

// A column as it lies in memory, to be read; it keeps its experiment alive.
py::array view(const ColumnBase &column, const py::object &owner) {
  const BlockType type = column.type();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(column.size())},
      strides{static_cast<py::ssize_t>(type.bytes_per_row())};
  if (type.numbers > 1) {
    shape.push_back(type.numbers);
    strides.push_back(type.bytes);
  }
  py::array array(type_of(type), shape, strides, column.bytes(), owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::dict views(const Table &table, const py::object &owner) {
  py::dict columns;
  for (const auto &column : table.columns())
    columns[py::str(column->name())] = view(*column, owner);
  return columns;
}

py::dict units(const Table &table) {
  py::dict units;
  for (const auto &column : table.columns())
    units[py::str(column->name())] = column->unit();
  return units;
}

// The turn of this thread. Python's lock is given back while another one has it: its callback needs that.
class Turn {
public:
  explicit Turn(const Experiment &experiment) : lock_(experiment.turn(), std::try_to_lock) {
    if (lock_) return;
    const py::gil_scoped_release released;
    lock_.lock();
  }

private:
  std::unique_lock<std::recursive_mutex> lock_;
};

// Of an experiment, in the turn of this thread.
template <class Look>
auto in_turn(const Look &look) {
  return [look](const Experiment &experiment) {
    const Turn turn(experiment);
    return look(experiment);
  };
}

// The same of what takes long, without Python's lock.
template <class Act>
auto in_long_turn(const Act &act) {
  return [act](Experiment &experiment) {
    const py::gil_scoped_release released;
    const std::lock_guard<std::recursive_mutex> turn(experiment.turn());
    return act(experiment);
  };
}

// What the file has in a cell: the shortest text that reads back to the same number.
double number_in(const apps::CsvCell &cell) {
  std::string text;
  cell.append_to(text);
  return text.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(text.c_str(), nullptr);
}

// Rows of history.csv so far, as the file has them.
py::dict history(const Experiment &experiment) {
  const std::vector<std::string> names = apps::history_names(&experiment.test());
  const std::vector<apps::Sample> &samples = experiment.samples();
  std::vector<py::array_t<double>> columns;
  for (std::size_t k = 0; k < names.size(); ++k)
    columns.emplace_back(static_cast<py::ssize_t>(samples.size()));
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const std::vector<apps::CsvCell> cells = apps::history_row(samples[row], &experiment.test());
    for (std::size_t k = 0; k < names.size(); ++k)
      columns[k].mutable_at(static_cast<py::ssize_t>(row)) = number_in(cells[k]);
  }
  py::dict table;
  for (std::size_t k = 0; k < names.size(); ++k)
    table[py::str(names[k])] = columns[k];
  return table;
}

// A row of history.csv by column.
py::dict row_of(const Experiment &experiment, const apps::Sample &sample) {
  const std::vector<std::string> names = apps::history_names(&experiment.test());
  const std::vector<apps::CsvCell> cells = apps::history_row(sample, &experiment.test());
  py::dict row;
  for (std::size_t k = 0; k < names.size(); ++k)
    row[py::str(names[k])] = number_in(cells[k]);
  return row;
}

// The class of platen/errors.py by its name.
py::object error_class(const char *name) {
  return py::module_::import("platen.errors").attr(name);
}

void set_error(const char *name, const std::string &text) {
  PyErr_SetString(error_class(name).ptr(), text.c_str());
}

// InputError(text, entry, file, line, reason) of the first of all faults.
void set_input_error(const std::string &text, const apps::EntryError *first) {
  py::object entry = py::none(), file = py::none(), line = py::none(), reason = py::str(text);
  if (first != nullptr) {
    const std::string what = first->what(), mark = ": error: ";
    const std::size_t found = what.find(mark);
    if (found != std::string::npos) reason = py::str(what.substr(found + mark.size()));
    if (!first->entry.empty()) entry = py::str(first->entry);
    if (!first->origin.file.empty()) file = py::str(first->origin.file);
    if (first->origin.line > 0) line = py::int_(first->origin.line);
  }
  const py::object error = error_class("InputError")(text, entry, file, line, reason);
  PyErr_SetObject(error_class("InputError").ptr(), error.ptr());
}

PyObject *refuse_without_scene(PyTypeObject *, PyObject *, PyObject *) {
  try {
    set_input_error("an experiment needs a scene: platen.Experiment(scene)", nullptr);
  } catch (py::error_already_set &error) { // no exception may leave this for Python
    error.restore();
  }
  return nullptr;
}

// The last translator that is registered is asked first.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const apps::SceneFaults &error) {
    set_input_error(error.what(), error.all.empty() ? nullptr : &error.all.front());
  } catch (const apps::EntryError &error) {
    set_input_error(error.what(), &error);
  } catch (const apps::InputError &error) {
    set_input_error(error.what(), nullptr);
  } catch (const coupling::BadSetup &error) {
    set_input_error(error.what(), nullptr);
  } catch (const BadParameter &error) {
    set_input_error(error.what(), nullptr);
  } catch (const coupling::NumericsStopped &error) {
    set_error("NumericsError", error.what());
  } catch (const apps::NumericsError &error) {
    set_error("NumericsError", error.what());
  } catch (const apps::OutputError &error) {
    set_error("OutputError", error.what());
  } catch (const std::filesystem::filesystem_error &error) {
    set_error("OutputError", error.what());
  } catch (const py::builtin_exception &) {
    throw; // Python's own
  } catch (const std::runtime_error &error) {
    set_error("PlatenError", error.what());
  } catch (const std::logic_error &error) {
    set_error("PlatenError", error.what());
  }
}

} // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of platen.";
  py::register_local_exception_translator(&translate);
  module.def("version_json", &apps::version_json);
  module.def("shipped_scenes", [] { return apps::shipped_scenes().string(); });

  module.def(
      "make",
      [](const std::string &scene, const std::vector<std::string> &overrides, const std::string &output,
         int threads, bool disc, bool overwrite, bool verbose) {
        const py::gil_scoped_release released;
        return std::make_unique<Experiment>(
            Experiment::Options{scene, output, overrides, threads, disc, overwrite, verbose});
      },
      py::arg("scene"), py::arg("overrides"), py::arg("output"), py::arg("threads"), py::arg("disc"),
      py::arg("overwrite"), py::arg("verbose"));
  // make() alone makes one: what __new__ gives would have nothing in it.
  py::class_<Experiment>(module, "Experiment", py::custom_type_setup([](PyHeapTypeObject *type) {
                           type->ht_type.tp_new = &refuse_without_scene;
                         }))
      .def("passes", in_long_turn([](Experiment &e) { e.pass(); }))
      .def("end", in_long_turn([](Experiment &e) { return e.end(); }))
      .def("close", in_long_turn([](Experiment &e) { e.close(); }))
      .def("change",
           [](Experiment &e, const std::vector<std::string> &assignments) {
             const Turn turn(e);
             e.change(assignments);
           })
      .def("listen",
           [](Experiment &e, const py::object &listener) {
             const Turn turn(e);
             if (listener.is_none()) return e.listen(nullptr);
             e.listen([&e, listener](const apps::Sample &sample) {
               const py::gil_scoped_acquire acquired;
               const py::object kept = listener; // which may put another one in its place
               kept(row_of(e, sample));
             });
           })
      .def_property_readonly("finished", in_turn([](const Experiment &e) { return e.finished(); }))
      .def_property_readonly("ended", in_turn([](const Experiment &e) { return e.ended(); }))
      .def_property_readonly("folder", [](const Experiment &e) { return py::bytes(e.folder()); })
      .def_property_readonly("time", in_turn([](const Experiment &e) { return e.test().time(); }))
      .def_property_readonly("time_step", in_turn([](const Experiment &e) { return e.test().time_step(); }))
      .def_property_readonly("steps", in_turn([](const Experiment &e) { return e.test().steps(); }))
      .def_property_readonly("strain", in_turn([](const Experiment &e) { return e.strain(); }))
      .def_property_readonly("stress", in_turn([](const Experiment &e) { return e.stress(); }))
      .def_property_readonly("samples", in_turn([](const Experiment &e) { return e.samples().size(); }))
      .def("history", in_turn(&history))
      .def("summary", in_turn([](const Experiment &e) { return e.summary(); }))
      .def("spheres",
           [](const py::object &self) {
             const Experiment &e = self.cast<const Experiment &>();
             const Turn turn(e);
             return views(e.test().model.particles.table, self);
           })
      .def("bonds",
           [](const py::object &self) {
             const Experiment &e = self.cast<const Experiment &>();
             const Turn turn(e);
             const auto &bonds = e.test().model.bonds;
             return bonds ? views(bonds->records, self) : py::dict();
           })
      .def("units", in_turn([](const Experiment &e) {
             py::dict all = units(e.test().model.particles.table);
             if (e.test().model.bonds) all.attr("update")(units(e.test().model.bonds->records));
             return all;
           }));
}

} // namespace platen::python
