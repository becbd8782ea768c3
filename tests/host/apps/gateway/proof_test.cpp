#include "host/apps/gateway/proof.hpp"

#include <gtest/gtest.h>

#include <set>

namespace liana::gateway {
namespace {

// RFC 4231, test cases 2 and 6 (a key longer than a block).
TEST(Proof, IsHmacSha256) {
  EXPECT_EQ(proof_of("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(proof_of(std::string(131, '\xaa'), "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

TEST(Proof, DependsOnTokenAndNonce) {
  EXPECT_NE(proof_of("a", "1"), proof_of("a", "2"));
  EXPECT_NE(proof_of("a", "1"), proof_of("b", "1"));
}

TEST(Nonce, IsNeverTheSame) {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) seen.insert(fresh_nonce());
  EXPECT_EQ(seen.size(), 1000u);
  for (const std::string& nonce : seen) EXPECT_EQ(nonce.size(), 64u);
}

TEST(Comparison, FindsEveryDifference) {
  EXPECT_TRUE(same_in_constant_time("abc", "abc"));
  for (const char* other : {"abd", "bbc", "ab", "abcd", ""}) EXPECT_FALSE(same_in_constant_time("abc", other)) << other;
}

}  // namespace
}  // namespace liana::gateway
