#include "dist/zoltan_cut.h"

#include <zoltan.h>

#include <memory>
#include <string>

namespace platen::dist {
namespace {

const BlockGraph &graph_behind(void *data) {
  return *static_cast<const BlockGraph *>(data);
}

int number_of_objects(void *data, int *error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(graph_behind(data).blocks());
}

void list_objects(void *data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float *weight,
                  int *error) {
  const BlockGraph &graph = graph_behind(data);
  for (std::size_t b = 0; b < graph.blocks(); ++b) {
    global[b] = local[b] = static_cast<ZOLTAN_ID_TYPE>(b);
    weight[b] = static_cast<float>(graph.weight[b]);
  }
  *error = ZOLTAN_OK;
}

int number_of_axes(void *, int *error) {
  *error = ZOLTAN_OK;
  return 3;
}

void list_centres(void *data, int, int, int count, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR, int, double *out,
                  int *error) {
  for (int k = 0; k < count; ++k)
    for (int axis = 0; axis < 3; ++axis)
      out[3 * k + axis] = graph_behind(data).centre[global[k]][axis];
  *error = ZOLTAN_OK;
}

void list_edge_numbers(void *data, int, int, int count, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR, int *edges,
                       int *error) {
  const BlockGraph &graph = graph_behind(data);
  for (int k = 0; k < count; ++k)
    edges[k] = static_cast<int>(graph.first_edge[global[k] + 1] - graph.first_edge[global[k]]);
  *error = ZOLTAN_OK;
}

void list_edges(void *data, int, int, int count, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR, int *,
                ZOLTAN_ID_PTR neighbour, int *rank, int, float *weight, int *error) {
  const BlockGraph &graph = graph_behind(data);
  for (int k = 0; k < count; ++k)
    for (std::size_t e = graph.first_edge[global[k]]; e < graph.first_edge[global[k] + 1]; ++e) {
      *neighbour++ = static_cast<ZOLTAN_ID_TYPE>(graph.neighbour[e]);
      *rank++ = 0; // of MPI_COMM_SELF
      *weight++ = static_cast<float>(graph.edge_weight[e]);
    }
  *error = ZOLTAN_OK;
}

struct Destroy {
  void operator()(Zoltan_Struct *zoltan) const { Zoltan_Destroy(&zoltan); }
};
using Zoltan = std::unique_ptr<Zoltan_Struct, Destroy>;

// The same cut in every call: no random seed from a clock.
void set_up(Zoltan_Struct *zoltan, int parts, PartitionMethod method, const BlockGraph &graph) {
  void *data = const_cast<BlockGraph *>(&graph); // no function below changes it
  const auto set = [zoltan](const char *name, const char *value) { Zoltan_Set_Param(zoltan, name, value); };
  set("DEBUG_LEVEL", "0");
  set("DETERMINISTIC", "TRUE");
  set("SEED", "20111207");
  set("NUM_GLOBAL_PARTS", std::to_string(parts).c_str());
  set("RETURN_LISTS", "PARTS");
  set("OBJ_WEIGHT_DIM", "1");
  set("IMBALANCE_TOL", "1.03");
  Zoltan_Set_Num_Obj_Fn(zoltan, number_of_objects, data);
  Zoltan_Set_Obj_List_Fn(zoltan, list_objects, data);
  Zoltan_Set_Num_Geom_Fn(zoltan, number_of_axes, data);
  Zoltan_Set_Geom_Multi_Fn(zoltan, list_centres, data);
  if (method == PartitionMethod::bisection) {
    set("LB_METHOD", "RCB");
    return;
  }
  set("LB_METHOD", "GRAPH");
  set("GRAPH_PACKAGE", "PHG");
  set("LB_APPROACH", "PARTITION");
  set("EDGE_WEIGHT_DIM", "1");
  set("PHG_EDGE_SIZE_THRESHOLD", "1.0"); // small graphs have blocks with many neighbours
  set("CHECK_GRAPH", "0");               // require_consistent has checked it
  Zoltan_Set_Num_Edges_Multi_Fn(zoltan, list_edge_numbers, data);
  Zoltan_Set_Edge_List_Multi_Fn(zoltan, list_edges, data);
}

// False where Zoltan fails.
bool find_cut(Zoltan_Struct *zoltan, int parts, std::vector<int> &part) {
  int changes = 0, gid_entries = 0, lid_entries = 0, imports = 0, exports = 0;
  ZOLTAN_ID_PTR import_global = nullptr, import_local = nullptr, export_global = nullptr,
                export_local = nullptr;
  int *import_ranks = nullptr, *import_parts = nullptr, *export_ranks = nullptr, *export_parts = nullptr;
  const int status = Zoltan_LB_Partition(
      zoltan, &changes, &gid_entries, &lid_entries, &imports, &import_global, &import_local, &import_ranks,
      &import_parts, &exports, &export_global, &export_local, &export_ranks, &export_parts);
  bool good =
      (status == ZOLTAN_OK || status == ZOLTAN_WARN) && static_cast<std::size_t>(exports) == part.size();
  for (int k = 0; good && k < exports; ++k) {
    good = export_global[k] < part.size() && export_parts[k] >= 0 && export_parts[k] < parts;
    if (good) part[export_global[k]] = export_parts[k];
  }
  Zoltan_LB_Free_Part(&import_global, &import_local, &import_ranks, &import_parts);
  Zoltan_LB_Free_Part(&export_global, &export_local, &export_ranks, &export_parts);
  return good;
}

} // namespace

std::optional<std::vector<int>> cut_by_zoltan(const BlockGraph &graph, int parts, PartitionMethod method) {
  if (method == PartitionMethod::graph && graph.neighbour.empty()) return std::nullopt;
  float version = 0;
  if (Zoltan_Initialize(0, nullptr, &version) != ZOLTAN_OK) return std::nullopt;
  const Zoltan zoltan(Zoltan_Create(MPI_COMM_SELF));
  if (!zoltan) return std::nullopt;
  set_up(zoltan.get(), parts, method, graph);
  std::vector<int> part(graph.blocks(), -1);
  if (!find_cut(zoltan.get(), parts, part)) return std::nullopt;
  return part;
}

} // namespace platen::dist
