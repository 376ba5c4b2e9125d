// cracks.vtu follows from cracks.csv alone.
#include <fstream>

#include "apps/output/crack_discs.h"
#include "apps/output/file.h"
#include "apps/scene/errors.h"
#include "scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

const char *header = "time_s,axial_strain,x_m,y_m,z_m,nx,ny,nz,area_m2,mode,energy_j,particle_a,particle_b\n";

class CrackDiscs : public ScratchFolder {
protected:
  void write(const std::string &rows) { std::ofstream(folder_ / "cracks.csv") << header << rows; }
  void discs() { write_crack_discs(folder_ / "cracks.csv", 1, folder_ / "cracks.vtu"); }
};

TEST_F(CrackDiscs, are_the_same_bytes_each_time_and_none_is_a_file_too) {
  write("1e-3,0.002,0,0,0.01,0,0,1,1e-6,tension,2e-6,3,4\n");
  discs();
  const std::string first = content_of(folder_ / "cracks.vtu");
  discs();
  EXPECT_EQ(first, content_of(folder_ / "cracks.vtu"));
  EXPECT_NE(first.find("NumberOfPoints=\"12\""), std::string::npos);
  write("");
  discs();
  EXPECT_NE(content_of(folder_ / "cracks.vtu").find("NumberOfCells=\"0\""), std::string::npos);
}

TEST_F(CrackDiscs, a_damaged_row_is_named) {
  write("1e-3,0.002,0,0,0.01,0,0,1,1e-6,bending,2e-6,3,4\n");
  EXPECT_NE(message_of<InputError>([&] { discs(); }).find("cracks.csv:2: mode: \"bending\""),
            std::string::npos);
  write("1e-3,0.002,0,0\n");
  EXPECT_NE(message_of<InputError>([&] { discs(); }).find(":2: 4 fields, 13 are wanted"), std::string::npos);
  write("1e-3,0.002,0,x,0.01,0,0,1,1e-6,shear,2e-6,3,4\n");
  EXPECT_NE(message_of<InputError>([&] { discs(); }).find("y_m: \"x\" is not a number"), std::string::npos);
}

} // namespace
} // namespace platen::apps
