// What the gateway answers to plain HTTP requests. Each ends its connection: the library is never led to a request
// behind another, or to a body, whose bytes it has once read from memory that it had freed.
#pragma once

#include <libwebsockets.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace liana::gateway {

// A short answer, whole; returns what the callback of libwebsockets has to return.
int answer_http(lws* connection, unsigned int status, const char* content_type, std::string_view body);

// Whose page it is: one of a foreign origin gets none of ours (CSP sandbox), so that its script can neither ask this
// gateway for anything nor read what a browser keeps for the console.
enum class PageSource : std::uint8_t { kOwn, kForeign };

// A file of HTML, or what to do where it is not there.
int answer_page(lws* connection, const std::string& file, PageSource source);

}  // namespace liana::gateway
