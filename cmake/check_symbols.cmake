# SPDX-License-Identifier: MIT
# cmake -D NM=... -D LIBRARY=... -P check_symbols.cmake: fails where a static library defines or needs a symbol of
# libsvm or of threads.
execute_process(COMMAND "${NM}" "${LIBRARY}" OUTPUT_VARIABLE symbols ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n]*(svm_|pthread|St6thread|St5async|jthread)[^ \n]*" found "${symbols}")
list(REMOVE_DUPLICATES found)
if(found)
  list(JOIN found "\n  " found)
  message(FATAL_ERROR "${LIBRARY} has\n  ${found}")
endif()
string(FIND "${symbols}" "fragmotion6Player4step" player)
if(player EQUAL -1)
  message(FATAL_ERROR "${LIBRARY} has no Player::step: these are not its symbols")
endif()
