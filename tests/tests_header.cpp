// Nothing of its own: the precompiled header of the tests wants a source.
