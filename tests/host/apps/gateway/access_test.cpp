#include "host/apps/gateway/access.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace liana::gateway {
namespace {

TEST(Roles, WatchMayStopAndNothingElse) {
  EXPECT_TRUE(may_ask(Access::kWatch, "stop"));
  for (const char* op : {"acquire", "move_jp", "device", "shutdown", "timing", "hello", ""})
    EXPECT_FALSE(may_ask(Access::kWatch, op)) << op;
}

TEST(Roles, OperateMayWhateverAClientMayButEndLianad) {
  for (const char* op : {"stop", "acquire", "move_jp", "device", "operator_says", "timing"})
    EXPECT_TRUE(may_ask(Access::kOperate, op)) << op;
  EXPECT_FALSE(may_ask(Access::kOperate, "shutdown"));
  EXPECT_TRUE(may_ask(Access::kAdminister, "shutdown"));
}

TEST(Roles, NobodySaysHelloForTheGateway) {
  for (const char* op : {"hello", "done"}) EXPECT_FALSE(may_ask(Access::kAdminister, op)) << op;
}

class TokenFile : public testing::Test {
 protected:
  TokenFile() : path_(testing::TempDir() + "liana_tokens_" + std::to_string(::getpid())) {}
  ~TokenFile() override { ::unlink(path_.c_str()); }
  const std::string& with(const std::string& text, unsigned mode = 0600) {
    std::ofstream(path_) << text;
    ::chmod(path_.c_str(), mode);
    return path_;
  }
  std::string refusal(const std::string& text, unsigned mode = 0600) {
    try {
      read_tokens(with(text, mode));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::string path_;
};

TEST_F(TokenFile, GivesEveryNameItsRoleAndToken) {
  const Tokens tokens =
      read_tokens(with("# people\n\nanna operate 0123456789abcdef\n  will\twatch fedcba9876543210\n"));
  ASSERT_EQ(tokens.size(), 2u);
  EXPECT_EQ(tokens.at("anna").access, Access::kOperate);
  EXPECT_EQ(tokens.at("anna").secret, "0123456789abcdef");
  EXPECT_EQ(tokens.at("will").access, Access::kWatch);
}

TEST_F(TokenFile, IsRefusedWhenOthersMayReadOrWriteIt) {
  for (const unsigned mode : {0640u, 0604u, 0620u, 0602u, 0610u})
    EXPECT_NE(refusal("anna operate 0123456789abcdef\n", mode).find("chmod 600"), std::string::npos) << mode;
}

TEST_F(TokenFile, IsRefusedWithLineAndWithoutTellingTheToken) {
  const char* bad[] = {"anna captain 0123456789abcdef",
                       "anna operate 0123456789abcde",
                       "anna operate",
                       "an/na operate 0123456789abcdef",
                       "anna operate 0123456789abcdef more",
                       "abcdefghijklmnopqrstuvwxyz0123456 watch 0123456789abcdef"};
  for (const char* line : bad) {
    const std::string said = refusal("# first\n" + std::string(line) + "\n");
    EXPECT_NE(said.find("line 2"), std::string::npos) << line;
    EXPECT_EQ(said.find("0123456789"), std::string::npos) << said;
  }
}

TEST_F(TokenFile, IsRefusedWithANameTwiceAndWithoutAnyToken) {
  EXPECT_NE(refusal("a watch 0123456789abcdef\na watch 0123456789abcdef\n").find("twice"), std::string::npos);
  EXPECT_NE(refusal("# nobody\n").find("no token"), std::string::npos);
}

}  // namespace
}  // namespace liana::gateway
