return require "..secrets"
