// What clients of the API are.
#pragma once

#include <array>
#include <cstdint>

namespace liana::api {

// What a client is; also the order in which clients are served (smaller first).
enum class Role : std::uint8_t { kMission, kOperator, kCamera, kArchive, kClient, kObserver, kTool };

constexpr std::array<const char*, 7> kRoleNames{"mission", "operator", "camera", "archive",
                                                "client",  "observer", "tool"};

// The name of a role.
constexpr const char* role_name(Role role) { return kRoleNames[static_cast<std::size_t>(role)]; }

// A set of roles, one bit each.
using Roles = std::uint8_t;

constexpr Roles only(Role role) { return static_cast<Roles>(1u << static_cast<unsigned>(role)); }
constexpr Roles kAnyRole = (1u << kRoleNames.size()) - 1;

// Roles that one client at a time has: the first that says hello, until it leaves.
constexpr Roles kSingleRoles =
    only(Role::kMission) | only(Role::kOperator) | only(Role::kCamera) | only(Role::kArchive) | only(Role::kTool);

}  // namespace liana::api
