# The rooms of fragmark, in order: each may use only rooms that stand before it in its list.
# tests/rooms_test.sh holds the objects' symbols and the #include lines against this order.
set(FM_RUNNER_ROOMS base decide image process code cache model mesh scene generators truth plugin describe bound spirv device
  glsl vulkan osmesa dummy simulator stage instance capture calibrate worker plan results parent child program bundle merge pack ab
  cli inspect
  share nightly regress)
set(FM_REPORT_ROOMS base decide image model read claims tradeoff stability compare baseline history night draw roofline page)

# fm_add_room(NAME SOURCES file... [ROOMS room...] [LIBRARIES target...]): the static library
# fm_NAME of one room, which links the rooms below it that it uses. Includes name a room's folder
# ("base/text.h"), but in the room itself.
function(fm_add_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "" "" "SOURCES;ROOMS;LIBRARIES")
  add_library(fm_${name} STATIC ${room_SOURCES})
  target_include_directories(fm_${name} PUBLIC ${PROJECT_SOURCE_DIR}/runner
    ${PROJECT_SOURCE_DIR}/runner/include ${PROJECT_SOURCE_DIR})
  if(name IN_LIST FM_REPORT_ROOMS)
    target_include_directories(fm_${name} PUBLIC ${PROJECT_SOURCE_DIR}/reports)
  endif()
  list(TRANSFORM room_ROOMS PREPEND fm_)
  target_link_libraries(fm_${name} PUBLIC fm_options ${room_ROOMS} PRIVATE ${room_LIBRARIES})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE folder)
  set_property(TARGET fm_${name} PROPERTY FM_FOLDER ${folder})
endfunction()

# fm_list_rooms(FILE room...): writes, when the build is made, a line for each room that there is: its
# name, folder and archive, in the order given.
function(fm_list_rooms file)
  set(lines)
  foreach(room IN LISTS ARGN)
    if(TARGET fm_${room})
      get_target_property(folder fm_${room} FM_FOLDER)
      string(APPEND lines "${room} ${folder} $<TARGET_FILE:fm_${room}>\n")
    endif()
  endforeach()
  file(GENERATE OUTPUT ${file} CONTENT "${lines}")
endfunction()
