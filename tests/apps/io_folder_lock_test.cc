#include "apps/io/output_folder.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/io/errors.h"
#include "io_folder.h"

namespace platen::apps {
namespace {

using namespace testing;
using std::chrono::milliseconds;

class Lock : public ScratchFolder {
protected:
  // A process that holds the folder until it is killed.
  pid_t holder() const {
    int ready[2];
    if (pipe(ready) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
      const FolderLock lock(folder_, milliseconds(0), [] {});
      if (write(ready[1], "1", 1) == 1) pause();
      _exit(1);
    }
    char one = 0;
    EXPECT_EQ(read(ready[0], &one, 1), 1);
    close(ready[0]);
    close(ready[1]);
    return child;
  }
  static void end(pid_t process) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
};

TEST_F(Lock, is_given_to_one_process_and_named_to_the_other) {
  const pid_t other = holder();
  int told = 0;
  const std::string text =
      message_of<FolderError>([&] { FolderLock(folder_, milliseconds(50), [&] { ++told; }); });
  EXPECT_TRUE(contains(text, "another run is at work in it")) << text;
  EXPECT_TRUE(contains(text, folder_.string())) << text;
  EXPECT_EQ(told, 1);
  end(other);
}

TEST_F(Lock, is_free_again_however_its_process_ends) {
  end(holder());
  int told = 0;
  {
    const FolderLock lock(folder_, milliseconds(0), [&] { ++told; });
  }
  const FolderLock again(folder_, milliseconds(0), [&] { ++told; });
  EXPECT_EQ(told, 0);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Lock, comes_after_a_wait) {
  const pid_t other = holder();
  const FolderLock lock(folder_, milliseconds(60000), [&] { end(other); });
  EXPECT_THROW(FolderLock(folder_, milliseconds(0), [] {}), FolderError); // ours, by another descriptor
}

TEST_F(Lock, that_is_shared_keeps_out_who_wants_it_alone) {
  const auto lock = [&](FolderLock::Hold hold) {
    return FolderLock(
        folder_, milliseconds(0), [] {}, hold);
  };
  {
    const FolderLock one = lock(FolderLock::Hold::shared), other = lock(FolderLock::Hold::shared);
    EXPECT_THROW(lock(FolderLock::Hold::alone), FolderError);
  }
  const FolderLock alone = lock(FolderLock::Hold::alone);
  EXPECT_THROW(lock(FolderLock::Hold::shared), FolderError);
}

TEST_F(Lock, of_no_folder_is_an_error) {
  EXPECT_THROW(FolderLock(folder_ / "none", milliseconds(0), [] {}), FolderError);
}

} // namespace
} // namespace platen::apps
