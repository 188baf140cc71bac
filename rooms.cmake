# The rooms of fragmark, in order: each may use only rooms that stand before it in its list.
# tests/rooms_test.sh holds the objects' symbols and the #include lines against this order.
set(FM_RUNNER_ROOMS base model scene generators truth plugin device vulkan osmesa dummy simulator stage
  instance capture worker plan parent cli)
set(FM_REPORT_ROOMS base model read draw claims page)

# fm_add_room(NAME SOURCES file... [ROOMS room...] [LIBRARIES target...]): the static library
# fm_NAME of one room, which links the rooms below it that it uses.
function(fm_add_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;ROOMS;LIBRARIES")
  target_sources(fm_runner PRIVATE ${room_SOURCES})
  target_link_libraries(fm_runner PUBLIC ${room_LIBRARIES})
endfunction()
