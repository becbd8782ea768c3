-- Scripts see what the sandbox gives them (host/apps/mission_runner/sandbox.cpp) and nothing else; tests/lua compares the two lists.
stds.liana = {
  read_globals = {
    "assert", "error", "getmetatable", "ipairs", "pairs", "pcall", "print", "rawequal", "rawget", "rawlen", "require",
    "select", "setmetatable", "tonumber", "tostring", "type", "xpcall",
    math = {
      fields = {
        "abs", "acos", "asin", "atan", "ceil", "cos", "deg", "exp", "floor", "fmod", "huge", "log", "max", "maxinteger",
        "min", "mininteger", "modf", "pi", "rad", "random", "sin", "sqrt", "tan", "tointeger", "type",
      },
    },
    string = {
      fields = { "byte", "char", "find", "format", "gmatch", "gsub", "len", "lower", "match", "rep", "reverse", "sub", "upper" },
    },
    table = { fields = { "concat", "insert", "pack", "remove", "sort", "unpack" } },
    coroutine = { fields = { "create", "isyieldable", "resume", "running", "status", "wrap", "yield" } },
  },
}
std = "liana"
max_line_length = 150
include_files = { "lua/**/*.lua", "tests/lua/*.lua" }
files["lua/liana/arm_stubs.lua"] = { ignore = { "212" } } -- arguments of stubs exist to be documented
