// Checkpoints: as they come, or (first byte odd) with checksums made to hold, so that what lies behind them
// is reached as well. All that opens is read out by every way that there is. With PLATEN_FUZZ_SEED in the
// environment it writes a small checkpoint to that file, to begin with, and ends.
#include <xxhash.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "apps/output/checkpoint.h"
#include "base/vector3.h"
#include "memory_file.h"

using namespace platen::apps;

namespace {

// Makes checksums, count of blocks and length hold, as far as blocks fit into the file.
void mend(std::string &bytes) {
  if (bytes.size() < sizeof(CheckpointHeader) + sizeof(CheckpointTrailer)) return;
  const std::size_t end = bytes.size() - sizeof(CheckpointTrailer);
  CheckpointTrailer trailer{};
  std::memcpy(trailer.magic, checkpoint_end, sizeof trailer.magic);
  for (std::size_t at = sizeof(CheckpointHeader); end - at >= sizeof(CheckpointBlockHeader);) {
    CheckpointBlockHeader block;
    std::memcpy(&block, &bytes[at], sizeof block);
    const std::uint64_t room = end - at - sizeof block;
    if (block.name_bytes > room || block.bytes > room - block.name_bytes) break;
    block.checksum = XXH64(&bytes[at] + sizeof block + block.name_bytes, block.bytes, 0);
    std::memcpy(&bytes[at], &block, sizeof block);
    at += sizeof block + block.name_bytes + block.bytes;
    ++trailer.blocks;
  }
  trailer.file_bytes = bytes.size();
  trailer.checksum = 0;
  std::memcpy(&bytes[end], &trailer, sizeof trailer);
  trailer.checksum = XXH64(bytes.data(), bytes.size() - sizeof trailer.checksum, 0);
  std::memcpy(&bytes[end], &trailer, sizeof trailer);
}

template <class Read>
void attempt(const Read &read) {
  try {
    read();
  } catch (const CheckpointError &) {
  } catch (const platen::StateError &) {
  }
}

struct Spheres {
  platen::Table table;
  std::uint64_t step = 0;
  std::vector<double> numbers;
  std::string reason;
  Spheres() {
    table.add<platen::Vector3>("position", "m");
    table.add<double>("radius", "m");
    table.add<int>("id", "1");
  }
  void describe(platen::Archive &archive) {
    archive.version(1);
    archive("step", step);
    archive.rows("numbers", numbers);
    archive.text("reason", reason);
    archive.table("particles", table);
  }
};

void read_out(const CheckpointReader &reader) {
  for (const std::string &name : reader.names()) {
    attempt([&] { platen::range_of(reader, name); });
    attempt([&] { platen::text_of(reader, name); });
    attempt([&] { platen::rows_of<double>(reader, name); });
  }
  attempt([&] { platen::first_difference(reader, reader); });
  attempt([&] {
    Spheres spheres;
    platen::read_parts(reader, [&](platen::Archive &archive) { archive.part("part", spheres); });
  });
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  const char *path = std::getenv("PLATEN_FUZZ_SEED");
  if (path == nullptr) return 0;
  Spheres spheres;
  spheres.table.resize(2);
  spheres.step = 12, spheres.numbers = {1, 2}, spheres.reason = "bond 1";
  CheckpointWriter writer(path);
  platen::save_part(writer, "part", spheres);
  writer.finish();
  std::exit(0);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size == 0) return 0;
  std::string bytes(reinterpret_cast<const char *>(data) + 1, size - 1);
  if (data[0] % 2 == 1) mend(bytes);
  const platen::fuzz::MemoryFile file(bytes.data(), bytes.size());
  attempt([&] { read_out(CheckpointReader(file.path())); });
  return 0;
}
