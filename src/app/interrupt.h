#pragma once
// Ctrl-C. The only state of the program that is not passed along: a signal handler can reach nothing else.

namespace promenade::app {

/// From now on SIGINT and SIGTERM ask the program to stop; a second one ends it at once.
void installInterruptHandlers();

/// Throws Interrupted if the user asked to stop. May be called from any thread.
void throwIfInterrupted();

}  // namespace promenade::app
