// The precompiled header needs a target that compiles it.
