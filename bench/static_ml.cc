#include "static_ml.h"

#include <AztecOO.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <ml_MultiLevelPreconditioner.h>
#include <Teuchos_ParameterList.hpp>

#include "base/clock.h"

namespace platen::bench {
namespace {

// Row-wise of each unknown: three translations, then rotations about the axes through the origin.
std::vector<double> rigid_motions(const std::vector<Vector3> &place, const std::vector<double> &length) {
  const std::size_t n = 6 * place.size();
  std::vector<double> modes(6 * n, 0.0);
  for (std::size_t i = 0; i < place.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      modes[k * n + 6 * i + k] = 1;
      const Vector3 axis{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
      const Vector3 u = cross(axis, place[i]);
      double *m = &modes[(3 + k) * n + 6 * i];
      m[0] = u.x, m[1] = u.y, m[2] = u.z;
      m[3 + k] = length[i];
    }
  return modes;
}

} // namespace

MlSolution solve_by_ml(const BlockMatrix<6, double> &a, const std::vector<Vector3> &place,
                       const std::vector<double> &length, const std::vector<double> &right,
                       double tolerance) {
  // Trilinos is built for MPI and does not go without.
  struct Mpi {
    Mpi() { MPI_Init(nullptr, nullptr); }
    ~Mpi() { MPI_Finalize(); }
  };
  static const Mpi mpi;
  MlSolution s;
  auto start = Clock::now();
  Epetra_MpiComm one(MPI_COMM_SELF);
  const Epetra_Map map(static_cast<int>(right.size()), 0, one);
  std::vector<int> counts(right.size());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t r = 0; r < 6; ++r)
      counts[6 * i + r] = static_cast<int>(6 * (a.begin[i + 1] - a.begin[i]));
  Epetra_CrsMatrix matrix(Copy, map, counts.data(), true);
  std::vector<double> values;
  std::vector<int> columns;
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (int r = 0; r < 6; ++r) {
      values.clear(), columns.clear();
      for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k)
        for (int c = 0; c < 6; ++c) {
          values.push_back(a.at(k)[6 * c + r]);
          columns.push_back(6 * a.column[k] + c);
        }
      matrix.InsertGlobalValues(6 * static_cast<int>(i) + r, static_cast<int>(values.size()), values.data(),
                                columns.data());
    }
  matrix.FillComplete();
  std::vector<double> modes = rigid_motions(place, length);
  Teuchos::ParameterList list;
  ML_Epetra::SetDefaults("SA", list);
  list.set("ML output", 0);
  list.set("PDE equations", 6);
  list.set("null space: type", "pre-computed");
  list.set("null space: add default vectors", false);
  list.set("null space: dimension", 6);
  list.set("null space: vectors", modes.data());
  list.set("smoother: type", "Chebyshev");
  list.set("smoother: sweeps", 2);
  list.set("coarse: type", "Amesos-KLU");
  ML_Epetra::MultiLevelPreconditioner multigrid(matrix, list);
  s.setup_seconds = seconds_since(start);

  start = Clock::now();
  s.x.assign(right.size(), 0.0);
  Epetra_Vector x(View, map, s.x.data()), b(Copy, map, const_cast<double *>(right.data()));
  Epetra_LinearProblem problem(&matrix, &x, &b);
  AztecOO solver(problem);
  solver.SetAztecOption(AZ_solver, AZ_cg);
  solver.SetAztecOption(AZ_output, AZ_none);
  solver.SetAztecOption(AZ_conv, AZ_rhs);
  solver.SetPrecOperator(&multigrid);
  solver.Iterate(5000, tolerance);
  s.iterations = solver.NumIters();
  s.solve_seconds = seconds_since(start);
  return s;
}

} // namespace platen::bench
