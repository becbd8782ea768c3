// What the gateway answers to plain HTTP requests. Each ends its connection: the library is never led to a request
// behind another, or to a body, whose bytes it has once read from memory that it had freed.
#pragma once

#include <libwebsockets.h>

#include <string>
#include <string_view>

namespace liana::gateway {

// A short answer, whole; returns what the callback of libwebsockets has to return.
int answer_http(lws* connection, unsigned int status, const char* content_type, std::string_view body);

// A file of HTML, or what to do where it is not there.
int answer_page(lws* connection, const std::string& file);

}  // namespace liana::gateway
